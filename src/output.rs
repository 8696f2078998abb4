//! The door out: from a film to a file.
