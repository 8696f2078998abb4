//! Which instruction sets there are, and which this machine has.

use std::fmt;
use std::str::FromStr;

/// An instruction set that this machine has, and for which there are kernels. All of them give the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Isa(Set);

/// The instruction sets that there are kernels for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Set {
    Scalar,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// Why an instruction set cannot be had.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum IsaError {
    /// No such name.
    #[error("LUCH_ISA: no instruction set is called {0:?}; set it to scalar, avx2 or avx512")]
    Unknown(String),
    /// Not on this machine.
    #[error("LUCH_ISA: this machine does not have {name}; set it to {available}, or unset it")]
    Missing {
        /// As asked.
        name: String,
        /// What could be asked instead.
        available: String,
    },
}

impl Isa {
    /// The environment variable that [`Isa::asked`] reads.
    pub const VARIABLE: &str = "LUCH_ISA";

    /// All that this machine has, the widest last.
    pub fn available() -> Vec<Isa> {
        let mut sets = vec![Set::Scalar];
        #[cfg(target_arch = "x86_64")]
        {
            let bits = is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("bmi2")
                && is_x86_feature_detected!("lzcnt")
                && is_x86_feature_detected!("popcnt");
            if bits && is_x86_feature_detected!("avx2") {
                sets.push(Set::Avx2);
                if is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512dq")
                    && is_x86_feature_detected!("avx512bw")
                {
                    sets.push(Set::Avx512);
                }
            }
        }
        sets.into_iter().map(Isa).collect()
    }

    /// That which every machine has: no instruction set at all.
    pub fn scalar() -> Isa {
        Isa(Set::Scalar)
    }

    /// The widest that this machine has.
    pub fn detect() -> Isa {
        Isa::available().pop().unwrap_or(Isa(Set::Scalar))
    }

    /// What the environment variable `LUCH_ISA` asks for: `scalar`, `avx2` or `avx512`; the widest where it is not set.
    ///
    /// # Errors
    ///
    /// Another name, or one that this machine does not have.
    pub fn asked() -> Result<Isa, IsaError> {
        match std::env::var_os(Isa::VARIABLE) {
            None => Ok(Isa::detect()),
            Some(name) => name.to_string_lossy().parse(),
        }
    }

    /// As in `LUCH_ISA`.
    pub fn name(self) -> &'static str {
        self.0.name()
    }

    pub(super) fn set(self) -> Set {
        self.0
    }
}

impl Set {
    fn name(self) -> &'static str {
        match self {
            Set::Scalar => "scalar",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => "avx512",
        }
    }
}

impl Default for Isa {
    fn default() -> Isa {
        Isa::detect()
    }
}

impl fmt::Display for Isa {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Isa {
    type Err = IsaError;

    fn from_str(name: &str) -> Result<Isa, IsaError> {
        let available = Isa::available();
        if let Some(isa) = available.iter().find(|isa| isa.name() == name) {
            return Ok(*isa);
        }
        if !["scalar", "avx2", "avx512"].contains(&name) {
            return Err(IsaError::Unknown(name.to_owned()));
        }
        let names: Vec<_> = available.iter().map(|isa| isa.name()).collect();
        Err(IsaError::Missing {
            name: name.to_owned(),
            available: names.join(" or "),
        })
    }
}
