//! The door to Embree 4, loaded at run time: the few functions that answer the same two questions as `luch::accel`.
#![allow(
    unsafe_code,
    reason = "calling a C library is unsafe; nothing outside this file knows that it is one"
)]

use super::embree_layouts::{
    Arguments, INDICES, INVALID, ROBUST, RtcRay, RtcRay16, RtcRayHit, RtcRayHit16, VERTICES,
};
use glam::Vec3;
use libloading::Library;
use std::ffi::{CString, c_char, c_int, c_uint, c_void};
use std::path::Path;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicIsize, Ordering::Relaxed};
use std::time::{Duration, Instant};

type Handle = *mut c_void;
type MemoryMonitor = extern "C" fn(*mut c_void, isize, bool) -> bool;

/// A loaded library.
pub(crate) struct Embree {
    new_device: unsafe extern "C" fn(*const c_char) -> Handle,
    release_device: unsafe extern "C" fn(Handle),
    device_property: unsafe extern "C" fn(Handle, c_int) -> isize,
    device_error: unsafe extern "C" fn(Handle) -> c_int,
    monitor_memory: unsafe extern "C" fn(Handle, MemoryMonitor, *mut c_void),
    new_geometry: unsafe extern "C" fn(Handle, c_int) -> Handle,
    new_buffer: unsafe extern "C" fn(Handle, c_int, c_uint, c_int, usize, usize) -> *mut c_void,
    commit_geometry: unsafe extern "C" fn(Handle),
    release_geometry: unsafe extern "C" fn(Handle),
    new_scene: unsafe extern "C" fn(Handle) -> Handle,
    attach_geometry: unsafe extern "C" fn(Handle, Handle) -> c_uint,
    set_quality: unsafe extern "C" fn(Handle, c_int),
    set_flags: unsafe extern "C" fn(Handle, c_int),
    commit_scene: unsafe extern "C" fn(Handle),
    release_scene: unsafe extern "C" fn(Handle),
    intersect: unsafe extern "C" fn(Handle, *mut RtcRayHit, *const Arguments),
    occluded: unsafe extern "C" fn(Handle, *mut RtcRay, *const Arguments),
    intersect16: unsafe extern "C" fn(*const c_int, Handle, *mut RtcRayHit16, *const Arguments),
    occluded16: unsafe extern "C" fn(*const c_int, Handle, *mut RtcRay16, *const Arguments),
    /// Last: the functions above are in it.
    _library: Library,
}

/// Embree's build qualities.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Quality {
    Medium = 1,
    High = 2,
}

/// How a scene is built.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Build {
    pub(crate) quality: Quality,
    pub(crate) robust: bool,
    pub(crate) threads: usize,
}

/// A built scene.
pub(crate) struct EmbreeScene<'a> {
    embree: &'a Embree,
    device: Handle,
    scene: Handle,
    memory: Box<Memory>,
    pub(crate) build_time: Duration,
}

/// Bytes, as Embree tells them.
#[derive(Default)]
struct Memory {
    now: AtomicIsize,
    peak: AtomicIsize,
}

impl Embree {
    /// Loads the library in a file.
    pub(crate) fn load(path: &Path) -> Result<Embree, String> {
        let error = |error| format!("{}: {error}", path.display());
        // SAFETY: Embree's initialisers have no preconditions; whoever names another library answers for it.
        let library = unsafe { Library::new(path) }.map_err(error)?;
        // SAFETY: each field's type is that of the function of this name in Embree 4's headers.
        unsafe {
            Ok(Embree {
                new_device: symbol(&library, "rtcNewDevice")?,
                release_device: symbol(&library, "rtcReleaseDevice")?,
                device_property: symbol(&library, "rtcGetDeviceProperty")?,
                device_error: symbol(&library, "rtcGetDeviceError")?,
                monitor_memory: symbol(&library, "rtcSetDeviceMemoryMonitorFunction")?,
                new_geometry: symbol(&library, "rtcNewGeometry")?,
                new_buffer: symbol(&library, "rtcSetNewGeometryBuffer")?,
                commit_geometry: symbol(&library, "rtcCommitGeometry")?,
                release_geometry: symbol(&library, "rtcReleaseGeometry")?,
                new_scene: symbol(&library, "rtcNewScene")?,
                attach_geometry: symbol(&library, "rtcAttachGeometry")?,
                set_quality: symbol(&library, "rtcSetSceneBuildQuality")?,
                set_flags: symbol(&library, "rtcSetSceneFlags")?,
                commit_scene: symbol(&library, "rtcCommitScene")?,
                release_scene: symbol(&library, "rtcReleaseScene")?,
                intersect: symbol(&library, "rtcIntersect1")?,
                occluded: symbol(&library, "rtcOccluded1")?,
                intersect16: symbol(&library, "rtcIntersect16")?,
                occluded16: symbol(&library, "rtcOccluded16")?,
                _library: library,
            })
        }
    }

    /// Builds a scene of triangles; their numbers are their places in the slice.
    pub(crate) fn build(
        &self,
        positions: &[Vec3],
        triangles: &[[u32; 3]],
        build: Build,
    ) -> Result<EmbreeScene<'_>, String> {
        // So that it can be held to what a lesser machine has: `LUCH_EMBREE_ISA=avx2`.
        let isa = std::env::var("LUCH_EMBREE_ISA");
        let isa = isa.map_or(String::new(), |isa| format!(",max_isa={isa}"));
        let config = CString::new(format!("threads={}{isa}", build.threads)).unwrap_or_default();
        let memory = Box::<Memory>::default();
        // SAFETY: the handles come from this library and are not null (a null device is refused by the next check;
        // the others are null only with a device's error, and Embree's functions take them then without harm). The
        // monitor's pointer is to a box that outlives the device, see `Drop`.
        unsafe {
            let device = (self.new_device)(config.as_ptr());
            if device.is_null() {
                return Err(format!(
                    "Embree gives no device: error {}",
                    (self.device_error)(null_mut())
                ));
            }
            (self.monitor_memory)(device, note_memory, (&raw const *memory).cast_mut().cast());
            let geometry = (self.new_geometry)(device, 0);
            self.fill(geometry, VERTICES, positions)?;
            self.fill(geometry, INDICES, triangles)?;
            let start = Instant::now();
            (self.commit_geometry)(geometry);
            let scene = (self.new_scene)(device);
            (self.attach_geometry)(scene, geometry);
            (self.release_geometry)(geometry);
            (self.set_quality)(scene, build.quality as c_int);
            (self.set_flags)(scene, if build.robust { ROBUST } else { 0 });
            // What the buffers take is no part of the tree.
            let buffers = memory.now.load(Relaxed);
            memory.peak.store(buffers, Relaxed);
            (self.commit_scene)(scene);
            let build_time = start.elapsed();
            memory.now.fetch_sub(buffers, Relaxed);
            memory.peak.fetch_sub(buffers, Relaxed);
            let built = EmbreeScene {
                embree: self,
                device,
                scene,
                memory,
                build_time,
            };
            match (self.device_error)(device) {
                0 => Ok(built),
                code => Err(format!("Embree builds no scene: error {code}")),
            }
        }
    }

    /// Copies items of 12 bytes into a new buffer of the geometry.
    ///
    /// # Safety
    ///
    /// `geometry` is one of this library, and `T` is three numbers of 32 bits.
    unsafe fn fill<T: Copy>(
        &self,
        geometry: Handle,
        [kind, format]: [c_int; 2],
        items: &[T],
    ) -> Result<(), String> {
        const { assert!(size_of::<T>() == 12) };
        // SAFETY: Embree gives a buffer of `items.len()` items of 12 bytes (and padding) or null.
        unsafe {
            let buffer = (self.new_buffer)(geometry, kind, 0, format, 12, items.len());
            if buffer.is_null() {
                return Err("Embree gives no buffer".into());
            }
            std::ptr::copy_nonoverlapping(items.as_ptr(), buffer.cast::<T>(), items.len());
        }
        Ok(())
    }
}

/// # Safety
///
/// `F` is the type of the function of this name.
unsafe fn symbol<F: Copy>(library: &Library, name: &str) -> Result<F, String> {
    // SAFETY: as above.
    let found = unsafe { library.get::<F>(name.as_bytes()) };
    found
        .map(|f| *f)
        .map_err(|_| format!("not an Embree 4: it has no {name}"))
}

extern "C" fn note_memory(memory: *mut c_void, bytes: isize, _after: bool) -> bool {
    // SAFETY: the pointer that `build` gave, to a box that outlives the device.
    let memory = unsafe { &*memory.cast::<Memory>() };
    let now = memory.now.fetch_add(bytes, Relaxed) + bytes;
    memory.peak.fetch_max(now, Relaxed);
    true
}

// SAFETY: a committed scene may be searched from any number of threads.
unsafe impl Sync for EmbreeScene<'_> {}

impl EmbreeScene<'_> {
    /// What the tree takes, and the most that its build took; bytes.
    pub(crate) fn memory(&self) -> [isize; 2] {
        [
            self.memory.now.load(Relaxed),
            self.memory.peak.load(Relaxed),
        ]
    }

    /// The widest instructions it uses, told by the packets that it takes whole.
    pub(crate) fn isa(&self) -> &'static str {
        // SAFETY: the device is this library's own. 33 and 34 are RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED and _RAY16_.
        let [eight, sixteen] = [33, 34]
            .map(|property| unsafe { (self.embree.device_property)(self.device, property) });
        match (eight, sixteen) {
            (_, 1) => "avx512",
            (1, _) => "avx2",
            _ => "sse",
        }
    }

    /// The nearest hit, by `rtcIntersect1`, left in `answer`.
    #[inline]
    pub(crate) fn intersect(&self, ray: &RtcRay, answer: &mut RtcRayHit) {
        answer.ray = *ray;
        answer.hit.geometry = INVALID;
        // SAFETY: the scene is committed, the structure aligned; null stands for the default arguments.
        unsafe { (self.embree.intersect)(self.scene, answer, null()) };
    }

    /// Whether anything is hit, by `rtcOccluded1`, left in `answer`.
    #[inline]
    pub(crate) fn occluded(&self, ray: &RtcRay, answer: &mut RtcRay) {
        *answer = *ray;
        // SAFETY: as in `intersect`.
        unsafe { (self.embree.occluded)(self.scene, answer, null()) };
    }

    /// The nearest hits of 16 rays, by `rtcIntersect16` for coherent rays, left in `answer`.
    #[inline]
    pub(crate) fn intersect16(&self, rays: &RtcRay16, answer: &mut RtcRayHit16) {
        answer.ray = *rays;
        answer.hit.geometry = [INVALID; 16];
        // SAFETY: as in `intersect`; the mask of lanes is 16 numbers, aligned as the rays' ids.
        unsafe { (self.embree.intersect16)(rays.valid(), self.scene, answer, &Arguments::COHERENT) }
    }

    /// Whether each of 16 rays hits anything, by `rtcOccluded16` for coherent rays, left in `answer`.
    #[inline]
    pub(crate) fn occluded16(&self, rays: &RtcRay16, answer: &mut RtcRay16) {
        *answer = *rays;
        // SAFETY: as in `intersect16`.
        unsafe { (self.embree.occluded16)(rays.valid(), self.scene, answer, &Arguments::COHERENT) }
    }
}

impl Drop for EmbreeScene<'_> {
    fn drop(&mut self) {
        // SAFETY: both are this value's own; the scene goes first, the memory's box after both.
        unsafe {
            (self.embree.release_scene)(self.scene);
            (self.embree.release_device)(self.device);
        }
    }
}
