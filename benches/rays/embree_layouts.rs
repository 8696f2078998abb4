//! What Embree 4 reads and writes: the structures and constants of `embree4/rtcore_*.h`, versions 4.3 and 4.4.

use luch::ray::Ray;
use std::ffi::{c_int, c_uint, c_void};
use std::ptr::null_mut;

/// `RTCRay`.
#[derive(Clone, Copy, Default)]
#[repr(C, align(16))]
pub(crate) struct RtcRay {
    pub(super) origin: [f32; 3],
    pub(super) near: f32,
    pub(super) direction: [f32; 3],
    pub(super) time: f32,
    pub(super) far: f32,
    pub(super) mask: u32,
    pub(super) id: u32,
    pub(super) flags: u32,
}

/// `RTCHit`; the last two are for instances.
#[derive(Clone, Copy, Default)]
#[repr(C, align(16))]
pub(super) struct RtcHit {
    pub(super) normal: [f32; 3],
    pub(super) uv: [f32; 2],
    pub(super) primitive: u32,
    pub(super) geometry: u32,
    pub(super) instance: u32,
    pub(super) instance_primitive: u32,
}

/// `RTCRayHit`.
#[derive(Clone, Copy, Default)]
#[repr(C, align(16))]
pub(crate) struct RtcRayHit {
    pub(super) ray: RtcRay,
    pub(super) hit: RtcHit,
}

/// `RTCRay16`.
#[derive(Clone, Copy, Default)]
#[repr(C, align(64))]
pub(crate) struct RtcRay16 {
    pub(super) origin: [[f32; 16]; 3],
    pub(super) near: [f32; 16],
    pub(super) direction: [[f32; 16]; 3],
    pub(super) time: [f32; 16],
    pub(super) far: [f32; 16],
    pub(super) mask: [u32; 16],
    pub(super) id: [u32; 16],
    pub(super) flags: [u32; 16],
}

/// `RTCHit16`.
#[derive(Clone, Copy, Default)]
#[repr(C, align(64))]
pub(super) struct RtcHit16 {
    pub(super) normal: [[f32; 16]; 3],
    pub(super) uv: [[f32; 16]; 2],
    pub(super) primitive: [u32; 16],
    pub(super) geometry: [u32; 16],
    pub(super) instance: [u32; 16],
    pub(super) instance_primitive: [u32; 16],
}

/// `RTCRayHit16`.
#[derive(Clone, Copy, Default)]
#[repr(C, align(64))]
pub(crate) struct RtcRayHit16 {
    pub(super) ray: RtcRay16,
    pub(super) hit: RtcHit16,
}

/// `RTCIntersectArguments` and `RTCOccludedArguments`, which are alike.
#[repr(C)]
pub(super) struct Arguments {
    pub(super) flags: c_uint,
    pub(super) features: c_uint,
    pub(super) context: *mut c_void,
    pub(super) filter: *mut c_void,
    pub(super) user_geometry: *mut c_void,
    /// Only in libraries that were built with minimal curve widths; beyond the end for others.
    pub(super) min_width_distance_factor: f32,
}

const _: () = assert!(size_of::<RtcRay>() == 48 && size_of::<RtcRayHit>() == 96);
const _: () = assert!(size_of::<RtcRay16>() == 768 && size_of::<RtcRayHit16>() == 1344);
const _: () = assert!(size_of::<Arguments>() == 40);

pub(super) const INVALID: u32 = u32::MAX;
/// `RTC_RAY_QUERY_FLAG_COHERENT`.
pub(super) const COHERENT_RAYS: c_uint = 1 << 16;
/// `RTC_FEATURE_FLAG_ALL`.
pub(super) const ALL_FEATURES: c_uint = u32::MAX;
/// `RTC_SCENE_FLAG_ROBUST`.
pub(super) const ROBUST: c_int = 1 << 2;
/// `RTC_BUFFER_TYPE_INDEX`, `RTC_FORMAT_UINT3`.
pub(super) const INDICES: [c_int; 2] = [0, 0x5003];
/// `RTC_BUFFER_TYPE_VERTEX`, `RTC_FORMAT_FLOAT3`.
pub(super) const VERTICES: [c_int; 2] = [1, 0x9003];

impl Arguments {
    pub(super) const COHERENT: Arguments = Arguments {
        flags: COHERENT_RAYS,
        features: ALL_FEATURES,
        context: null_mut(),
        filter: null_mut(),
        user_geometry: null_mut(),
        min_width_distance_factor: 0.0,
    };
}

impl RtcRay {
    pub(crate) fn of(ray: &Ray) -> RtcRay {
        RtcRay {
            origin: ray.origin.to_array(),
            near: ray.t_min,
            direction: ray.direction.to_array(),
            time: 0.0,
            far: ray.t_max,
            mask: u32::MAX,
            id: 0,
            flags: 0,
        }
    }
}

/// The nearest hit: distance and triangle.
pub(crate) type Nearest = Option<(f32, u32)>;

impl RtcRay {
    /// Whether `rtcOccluded1` found something; the distance and triangle stay untold.
    pub(crate) fn found(&self) -> Nearest {
        (self.far == f32::NEG_INFINITY).then_some((0.0, 0))
    }
}

impl RtcRayHit {
    /// What `rtcIntersect1` found.
    pub(crate) fn nearest(&self) -> Nearest {
        (self.hit.geometry != INVALID).then_some((self.ray.far, self.hit.primitive))
    }
}

impl RtcRay16 {
    /// What `rtcOccluded16` found on each lane that has a ray.
    pub(crate) fn found(&self) -> impl Iterator<Item = Nearest> {
        let found = |lane: usize| (self.far[lane] == f32::NEG_INFINITY).then_some((0.0, 0));
        self.lanes().map(found)
    }

    /// The lanes that have a ray.
    fn lanes(&self) -> impl Iterator<Item = usize> {
        (0..16).filter(|&lane| self.id[lane] != 0)
    }
}

impl RtcRayHit16 {
    /// What `rtcIntersect16` found on each lane that has a ray.
    pub(crate) fn nearest(&self) -> impl Iterator<Item = Nearest> {
        let hit = &self.hit;
        let nearest = |lane: usize| {
            (hit.geometry[lane] != INVALID).then_some((self.ray.far[lane], hit.primitive[lane]))
        };
        self.ray.lanes().map(nearest)
    }
}

impl RtcRay16 {
    /// At most 16 rays; lanes without one are not valid.
    pub(crate) fn of(rays: &[Ray]) -> RtcRay16 {
        let lanes: [Option<&Ray>; 16] = std::array::from_fn(|lane| rays.get(lane));
        let numbers = |of: fn(&Ray) -> f32| lanes.map(|ray| ray.map_or(0.0, of));
        RtcRay16 {
            origin: [
                numbers(|r| r.origin.x),
                numbers(|r| r.origin.y),
                numbers(|r| r.origin.z),
            ],
            near: numbers(|r| r.t_min),
            direction: [
                numbers(|r| r.direction.x),
                numbers(|r| r.direction.y),
                numbers(|r| r.direction.z),
            ],
            time: [0.0; 16],
            far: numbers(|r| r.t_max),
            mask: [u32::MAX; 16],
            // Embree does not read the ids, and it wants its valid lanes as such an array of 0 and -1.
            id: lanes.map(|ray| if ray.is_some() { u32::MAX } else { 0 }),
            flags: [0; 16],
        }
    }

    /// Which lanes have a ray.
    pub(super) fn valid(&self) -> *const c_int {
        self.id.as_ptr().cast()
    }
}
