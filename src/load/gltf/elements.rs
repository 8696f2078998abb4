//! The elements of an accessor, of every component type.

use gltf::json::accessor::ComponentType;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};

/// The elements of an accessor.
#[derive(Debug)]
pub(super) struct Elements<'a> {
    /// How many there are.
    pub(super) count: usize,
    /// How many numbers each has.
    pub(super) components: usize,
    pub(super) component: ComponentType,
    pub(super) normalized: bool,
    /// Zeros where there is none.
    pub(super) base: Option<Spaced<'a>>,
    /// What sparse storage changes: which element, and its bytes. Sorted, each element once.
    pub(super) changes: Vec<(u32, &'a [u8])>,
}

/// Elements `stride` bytes apart.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spaced<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) stride: usize,
    pub(super) size: usize,
}

/// Fewer elements than these are not worth a thread.
const PIECE: usize = 1 << 14;

impl<'a> Spaced<'a> {
    /// Element `i`; empty past the end.
    pub(super) fn element(&self, i: usize) -> &'a [u8] {
        let start = i.saturating_mul(self.stride);
        self.bytes
            .get(start..start.saturating_add(self.size))
            .unwrap_or_default()
    }
}

impl<'a> Elements<'a> {
    /// `count` elements without anything between them.
    pub(super) fn packed(
        bytes: &'a [u8],
        count: usize,
        components: usize,
        component: ComponentType,
        normalized: bool,
    ) -> Elements<'a> {
        let size = components * component.size();
        Elements {
            count,
            components,
            component,
            normalized,
            base: Some(Spaced {
                bytes,
                stride: size,
                size,
            }),
            changes: Vec::new(),
        }
    }

    /// Whether its numbers are ones that vertices can be counted with.
    pub(super) fn counts(&self) -> bool {
        matches!(
            self.component,
            ComponentType::U8 | ComponentType::U16 | ComponentType::U32
        )
    }

    /// Every whole number.
    pub(super) fn indices(&self) -> Vec<u32> {
        (0..self.count).map(|i| self.index(i)).collect()
    }

    /// Every whole number, three by three; one or two that are left over at the end are not among them.
    pub(super) fn index_triples(&self) -> Vec<[u32; 3]> {
        let component = self.component;
        match &self.base {
            Some(base) if self.changes.is_empty() && base.stride == base.size => match component {
                ComponentType::U32 => triples(base.bytes, u32::from_le_bytes),
                ComponentType::U16 => triples(base.bytes, |b| u16::from_le_bytes(b).into()),
                _ => triples(base.bytes, |b: [u8; 1]| whole(&b, component)),
            },
            _ => (0..self.count / 3)
                .map(|triangle| [0, 1, 2].map(|corner| self.index(3 * triangle + corner)))
                .collect(),
        }
    }

    /// Element `i` as a whole number.
    pub(super) fn index(&self, i: usize) -> u32 {
        whole(self.element(i), self.component)
    }

    /// Element `i` as numbers, normalized integers as shares from -1 or 0 to 1; zero for those it does not have.
    pub(super) fn floats<const N: usize>(&self, i: usize) -> [f32; N] {
        self.numbers(self.element(i))
    }

    /// What `make` makes of each of the first `count` elements.
    pub(super) fn first<const N: usize, T: Send>(
        &self,
        count: usize,
        make: impl Fn([f32; N]) -> T + Send + Sync,
    ) -> Vec<T> {
        let mut made: Vec<T> = match &self.base {
            Some(base) if self.component == ComponentType::F32 => each(count, |i| {
                let (numbers, _) = base.element(i).as_chunks();
                let at = |c| numbers.get(c).map_or(0.0, |&b| f32::from_le_bytes(b));
                make(std::array::from_fn(at))
            }),
            Some(base) => each(count, |i| make(self.numbers(base.element(i)))),
            None => each(count, |_| make([0.0; N])),
        };
        for &(index, bytes) in &self.changes {
            if let Some(one) = made.get_mut(index as usize) {
                *one = make(self.numbers(bytes));
            }
        }
        made
    }

    /// The elements that may be other than zero, in rising order.
    pub(super) fn stored(&self) -> Vec<u32> {
        match self.base {
            Some(_) => (0..u32::try_from(self.count).unwrap_or(u32::MAX)).collect(),
            None => self.changes.iter().map(|&(index, _)| index).collect(),
        }
    }

    /// How many elements [`Elements::stored`] has.
    pub(super) fn stored_count(&self) -> usize {
        match self.base {
            Some(_) => self.count,
            None => self.changes.len(),
        }
    }

    /// Every number of every element, in order.
    pub(super) fn all_numbers(&self) -> Vec<f32> {
        let size = self.component.size();
        let mut numbers = Vec::with_capacity(self.count.saturating_mul(self.components));
        for i in 0..self.count {
            let element = self.element(i);
            numbers.extend((0..self.components).map(|c| {
                let number = element.get(c * size..).unwrap_or_default();
                float(number, self.component, self.normalized)
            }));
        }
        numbers
    }

    fn numbers<const N: usize>(&self, element: &[u8]) -> [f32; N] {
        let size = self.component.size();
        std::array::from_fn(|c| {
            let number = element.get(c * size..).unwrap_or_default();
            float(number, self.component, self.normalized)
        })
    }

    /// The bytes of element `i`; empty where it is zero.
    fn element(&self, i: usize) -> &[u8] {
        let changed = self
            .changes
            .binary_search_by_key(&(i as u64), |&(index, _)| u64::from(index));
        match (changed, &self.base) {
            (Ok(at), _) => self.changes.get(at).map_or(&[], |&(_, bytes)| bytes),
            (Err(_), Some(base)) => base.element(i),
            (Err(_), None) => &[],
        }
    }
}

fn each<T: Send>(count: usize, make: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    (0..count)
        .into_par_iter()
        .with_min_len(PIECE)
        .map(make)
        .collect()
}

/// Numbers of `N` bytes, three by three.
fn triples<const N: usize>(bytes: &[u8], number: impl Fn([u8; N]) -> u32 + Sync) -> Vec<[u32; 3]> {
    let (numbers, _) = bytes.as_chunks::<N>();
    let (triples, _) = numbers.as_chunks::<3>();
    triples
        .into_par_iter()
        .with_min_len(PIECE)
        .map(|triple| triple.map(&number))
        .collect()
}

/// The first number in `bytes`, a whole one; zero where there is none.
pub(super) fn whole(bytes: &[u8], component: ComponentType) -> u32 {
    let read = match component {
        ComponentType::U8 => bytes.first().map(|&b| u32::from(b)),
        ComponentType::U16 => bytes
            .first_chunk()
            .map(|&b| u32::from(u16::from_le_bytes(b))),
        ComponentType::U32 => bytes.first_chunk().map(|&b| u32::from_le_bytes(b)),
        ComponentType::I8 | ComponentType::I16 | ComponentType::F32 => None,
    };
    read.unwrap_or_default()
}

/// The first number in `bytes`; zero where there is none.
fn float(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let (value, greatest) = match component {
        ComponentType::F32 => {
            return bytes.first_chunk().map_or(0.0, |&b| f32::from_le_bytes(b));
        }
        ComponentType::U32 => {
            return bytes
                .first_chunk()
                .map_or(0.0, |&b| u32::from_le_bytes(b) as f32);
        }
        ComponentType::I8 => (bytes.first().map(|&b| f32::from(b as i8)), 127.0),
        ComponentType::U8 => (bytes.first().map(|&b| f32::from(b)), 255.0),
        ComponentType::I16 => (
            bytes
                .first_chunk()
                .map(|&b| f32::from(i16::from_le_bytes(b))),
            32_767.0,
        ),
        ComponentType::U16 => (
            bytes
                .first_chunk()
                .map(|&b| f32::from(u16::from_le_bytes(b))),
            65_535.0,
        ),
    };
    let value = value.unwrap_or_default();
    if normalized {
        (value / greatest).max(-1.0) // Two's complement has one more below than above.
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normalized_integers_become_shares() {
        let share = |bytes: &[u8], component| float(bytes, component, true);
        assert_eq!(share(&[255], ComponentType::U8), 1.0);
        assert_eq!(share(&[0x80], ComponentType::I8), -1.0);
        assert_eq!(share(&[0x81], ComponentType::I8), -1.0);
        assert_eq!(share(&[0xff, 0x7f], ComponentType::I16), 1.0);
        assert_eq!(share(&[0, 0x80], ComponentType::I16), -1.0);
        assert_eq!(share(&[0xff, 0xff], ComponentType::U16), 1.0);
        assert_eq!(float(&[7], ComponentType::U8, false), 7.0);
    }

    #[test]
    fn whole_numbers_are_little_endian() {
        let bytes = [1, 2, 3, 4];
        assert_eq!(whole(&bytes, ComponentType::U8), 1);
        assert_eq!(whole(&bytes, ComponentType::U16), 0x0201);
        assert_eq!(whole(&bytes, ComponentType::U32), 0x0403_0201);
        assert_eq!(whole(&[1, 2, 3], ComponentType::U32), 0);
    }
}
