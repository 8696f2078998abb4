//! Where labels of single points stand: beside them, and on nothing else.

/// A rectangle in layout units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Area {
    /// The square of twice `radius` about a point.
    pub(super) fn around((x, y): (f64, f64), radius: f64) -> Area {
        Area {
            left: x - radius,
            top: y - radius,
            right: x + radius,
            bottom: y + radius,
        }
    }

    fn meets(&self, other: &Area) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    fn within(&self, other: &Area) -> bool {
        self.left >= other.left
            && self.right <= other.right
            && self.top >= other.top
            && self.bottom <= other.bottom
    }
}

/// The first place beside the point `at` where a label of the size `(width, height)` is within `bounds` and meets none of
/// the `taken`.
pub(super) fn beside(
    at: (f64, f64),
    (width, height): (f64, f64),
    gap: f64,
    bounds: &Area,
    taken: &[Area],
) -> Option<Area> {
    let (x, y) = at;
    let near = gap * 0.7;
    let corners = [
        (x + gap, y - height / 2.0),
        (x + near, y - near - height),
        (x + near, y + near),
        (x - width / 2.0, y - gap - height),
        (x - width / 2.0, y + gap),
        (x - near - width, y - near - height),
        (x - near - width, y + near),
        (x - gap - width, y - height / 2.0),
    ];
    corners
        .into_iter()
        .map(|(left, top)| Area {
            left,
            top,
            right: left + width,
            bottom: top + height,
        })
        .find(|area| area.within(bounds) && !taken.iter().any(|other| area.meets(other)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Area = Area {
        left: 0.0,
        top: 0.0,
        right: 100.0,
        bottom: 100.0,
    };

    #[test]
    fn a_label_stands_to_the_right_and_elsewhere_where_that_is_taken() {
        let size = (20.0, 10.0);
        let free = beside((50.0, 50.0), size, 5.0, &BOUNDS, &[]);
        assert_eq!(free.map(|area| area.left), Some(55.0));
        let neighbour = Area::around((60.0, 50.0), 3.0);
        let moved = beside((50.0, 50.0), size, 5.0, &BOUNDS, &[neighbour]);
        assert!(moved.is_some_and(|area| !area.meets(&neighbour)));
        let edge = beside((95.0, 50.0), size, 5.0, &BOUNDS, &[]);
        assert!(edge.is_some_and(|area| area.right <= 100.0));
    }

    #[test]
    fn a_label_without_room_is_not_shown() {
        assert_eq!(beside((50.0, 50.0), (200.0, 10.0), 5.0, &BOUNDS, &[]), None);
        assert_eq!(
            beside((50.0, 50.0), (20.0, 10.0), 5.0, &BOUNDS, &[BOUNDS]),
            None
        );
    }
}
