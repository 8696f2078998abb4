//! What rays walk through, in huge pages where there is much of it.
//!
//! Nearly every step of a walk down a big tree is to another page, and a processor knows the places of some thousand
//! pages by heart: with pages of 4 KiB that is a few megabytes. `benches/rays.rs`, both side by side in one process:
//! incoherent rays in `interior` and mirror rays on `terrain-1m` gained a tenth and a fourteenth, the others nothing that
//! stands out of the noise.

use std::alloc::{Layout, alloc, dealloc, handle_alloc_error};
use std::ops::{Deref, DerefMut};
use std::ptr::NonNull;

/// A huge page of x86-64, and of aarch64 where the small ones have 4 KiB.
const HUGE: usize = 2 << 20;

/// A slice that does not grow, its start on the border of a huge page if it is long.
pub(in crate::accel) struct Pages<T> {
    first: NonNull<T>,
    count: usize,
    /// What was allocated; nothing where its size is 0.
    layout: Layout,
}

// SAFETY: it owns its items, as a `Vec` does.
unsafe impl<T: Send> Send for Pages<T> {}
// SAFETY: what is shared of it is only read, as with a `Vec`.
unsafe impl<T: Sync> Sync for Pages<T> {}

impl<T: Copy> Pages<T> {
    /// `count` times the same.
    pub(in crate::accel) fn filled(item: T, count: usize) -> Pages<T> {
        Pages::written(count, |_| item)
    }

    /// A copy.
    pub(in crate::accel) fn of(items: &[T]) -> Pages<T> {
        Pages::written(items.len(), |index| items[index])
    }

    fn written(count: usize, item: impl Fn(usize) -> T) -> Pages<T> {
        // As with a `Vec`, more than the address space holds is out of memory.
        let slice =
            Layout::array::<T>(count).unwrap_or_else(|_| handle_alloc_error(Layout::new::<T>()));
        let layout = room(slice);
        if layout.size() == 0 {
            return Pages {
                first: NonNull::dangling(),
                count,
                layout,
            };
        }
        // SAFETY: the layout's size is not 0.
        let memory = unsafe { alloc(layout) };
        let Some(first) = NonNull::new(memory.cast::<T>()) else {
            handle_alloc_error(layout)
        };
        if layout.align() == HUGE {
            ask_for_huge_pages(first.cast(), layout.size());
        }
        for index in 0..count {
            // SAFETY: the new memory is aligned for `count` items, and has room for them.
            unsafe { first.as_ptr().add(index).write(item(index)) };
        }
        Pages {
            first,
            count,
            layout,
        }
    }
}

/// The memory for a slice of this layout: from the border of a huge page on if there is one to fill, and to the border of
/// one if that wastes little.
fn room(slice: Layout) -> Layout {
    let whole = slice.size().next_multiple_of(HUGE);
    let size = if whole - slice.size() <= slice.size() / 4 {
        whole
    } else {
        slice.size()
    };
    if size < HUGE {
        return slice;
    }
    Layout::from_size_align(size, HUGE).unwrap_or(slice)
}

/// Only asks: where the system has none, or is not Linux, the pages stay small.
fn ask_for_huge_pages(start: NonNull<u8>, size: usize) {
    #[cfg(target_os = "linux")]
    // SAFETY: the range is ours, and the advice changes no byte of it.
    unsafe {
        libc::madvise(start.as_ptr().cast(), size, libc::MADV_HUGEPAGE);
    }
    #[cfg(not(target_os = "linux"))]
    let _ = (start, size);
}

impl<T> Deref for Pages<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        // SAFETY: `written` put so many items there; where nothing was allocated, none is read.
        unsafe { std::slice::from_raw_parts(self.first.as_ptr(), self.count) }
    }
}

impl<T> DerefMut for Pages<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        // SAFETY: as in `deref`, and this is the only reference.
        unsafe { std::slice::from_raw_parts_mut(self.first.as_ptr(), self.count) }
    }
}

impl<T> Drop for Pages<T> {
    fn drop(&mut self) {
        if self.layout.size() != 0 {
            // SAFETY: allocated in `written` with this layout; the items are `Copy` and need no drop.
            unsafe { dealloc(self.first.as_ptr().cast(), self.layout) }
        }
    }
}

impl<T: Copy> Default for Pages<T> {
    fn default() -> Pages<T> {
        Pages::of(&[])
    }
}

impl<T: Copy> Clone for Pages<T> {
    fn clone(&self) -> Pages<T> {
        Pages::of(self)
    }
}

impl<T: std::fmt::Debug> std::fmt::Debug for Pages<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holds_what_it_was_given_be_it_nothing_little_or_much() {
        for count in [0, 1, 1000, 520_000, 600_000] {
            let items: Vec<u32> = (0..count).collect();
            let pages = Pages::of(&items);
            assert_eq!(*pages, *items);
            assert_eq!(*pages.clone(), *items);
            assert_eq!(*Pages::filled(7, items.len()), *vec![7; items.len()]);
        }
    }

    #[test]
    fn whole_huge_pages_where_they_waste_at_most_a_fifth() {
        let of = |size| {
            let room = room(Layout::from_size_align(size, 64).expect("a layout"));
            (room.size(), room.align())
        };
        assert_eq!(of(0), (0, 64));
        assert_eq!(of(HUGE - HUGE / 4), (HUGE - HUGE / 4, 64));
        assert_eq!(of(HUGE - HUGE / 5), (HUGE, HUGE));
        assert_eq!(of(HUGE), (HUGE, HUGE));
        assert_eq!(of(HUGE + 1), (HUGE + 1, HUGE));
        assert_eq!(of(9 * HUGE + 1), (10 * HUGE, HUGE));
    }
}
