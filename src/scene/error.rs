//! What can be wrong with a scene: facts as fields, the sentence in `Display`.

/// What is wrong with a scene. `what` names the thing, as in `sphere 3`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// A number is infinite or no number.
    #[error("{what}: {field} must be finite numbers")]
    NotFinite {
        /// The thing.
        what: String,
        /// The field of it.
        field: &'static str,
    },
    /// A number lies outside its range.
    #[error("{what}: {field} is {found}, expected {expected}")]
    OutOfRange {
        /// The thing.
        what: String,
        /// The field of it.
        field: &'static str,
        /// Its value.
        found: f32,
        /// As in "a number above 0".
        expected: &'static str,
    },
    /// A direction has no length.
    #[error("{what}: {field} has no length, expected a direction")]
    NoLength {
        /// The thing.
        what: String,
        /// The field of it.
        field: &'static str,
    },
    /// The camera stands where it looks.
    #[error("camera: look_at equals position, so that it looks nowhere")]
    LooksNowhere,
    /// An index names nothing.
    #[error("{what}: {field} {index} does not exist, there are {count}")]
    NoSuch {
        /// The thing.
        what: String,
        /// What the index names.
        field: &'static str,
        /// The index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// Two lists that belong together have different lengths.
    #[error("{what}: {found} {field} for {expected}")]
    LengthMismatch {
        /// The thing.
        what: String,
        /// The list.
        field: &'static str,
        /// Its length.
        found: usize,
        /// What it should match, as in "8 positions".
        expected: String,
    },
    /// A checkerboard on something that is no plane.
    #[error("{what}: material \"{material}\" has a checker, which only planes can have")]
    CheckerNotOnPlane {
        /// The thing.
        what: String,
        /// Its material.
        material: String,
    },
    /// A mesh is so far from the origin, or so large, that 32 bits cannot reckon with it.
    #[error("{what}: its mesh reaches {reach:e} from the origin, expected at most 1e15")]
    TooFar {
        /// The thing.
        what: String,
        /// The greatest coordinate in the world.
        reach: f32,
    },
    /// It takes more memory than there is.
    #[error(
        "the scene with its search tree takes {} MB of memory, {} MB are left; make it smaller, or allow more with --max-memory",
        needs.div_ceil(1_000_000),
        left / 1_000_000
    )]
    OutOfMemory {
        /// What it takes, in bytes.
        needs: u64,
        /// What there is for it, in bytes.
        left: u64,
    },
    /// More primitives than 31 bits can number.
    #[error("{count} primitives are more than {} (instances count)", i32::MAX)]
    TooManyPrimitives {
        /// Spheres, planes and triangles of all instances.
        count: u64,
    },
}
