//! What a user says of reading a file, before anything of it is known.

/// How a file is to be read. The default is what a stranger's file deserves: nothing outside its folder is read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The scene of a glTF file, by name or, if none has it and it is a number, by index; the file's own where `None`.
    pub scene: Option<String>,
    /// The variant of materials of a glTF file (KHR_materials_variants), by name or by index.
    pub variant: Option<String>,
    /// Which animations of a glTF file move it.
    pub animation: AnimationChoice,
    /// Extensions that luch lacks and without which a file may be read all the same, though it requires them.
    pub allow: Vec<String>,
    /// Whether a model may name files outside its own folder.
    pub allow_external: bool,
    /// Bytes that reading may take in all; three quarters of what the machine and its limits leave where `None`.
    pub max_memory: Option<u64>,
}

/// Which animations of a file move it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AnimationChoice {
    /// None: things stand as the file places them.
    #[default]
    None,
    /// The first, if there is one.
    First,
    /// The one of this name or, if none has it and it is a number, of this index.
    Named(String),
    /// Every one, the later over the earlier.
    All,
}
