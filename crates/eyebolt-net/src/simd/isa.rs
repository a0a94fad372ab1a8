//! Which instructions this CPU has.

/// A set of instructions that this CPU can run.
///
/// Whoever has one has found it here, at run time: there is no other way to make one, and so it is
/// the proof that code for these instructions may be called.
///
/// ```
/// use eyebolt_net::Isa;
///
/// assert!(Isa::available().contains(&Isa::detect()));
/// ```
///
/// None is made by name, and none from its parts:
///
/// ```compile_fail,E0599
/// let isa = eyebolt_net::Isa::Avx512;
/// ```
///
/// ```compile_fail,E0423
/// let isa = eyebolt_net::Isa(todo!());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Isa(Instructions);

/// The sets that there is code for; of this CPU's architecture, as what others could run is never
/// found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Instructions {
    /// x86-64 with 512-bit registers.
    #[cfg(target_arch = "x86_64")]
    Avx512,
    /// x86-64 with 256-bit registers and fused multiply-add.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// 64-bit ARM.
    #[cfg(target_arch = "aarch64")]
    Neon,
    /// What the compiler makes of plain loops.
    Scalar,
}

impl Isa {
    /// All that this CPU can run, the fastest first.
    pub fn available() -> Vec<Self> {
        let mut found = Vec::new();
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx512f") {
                found.push(Self(Instructions::Avx512));
            }
            if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
                found.push(Self(Instructions::Avx2));
            }
        }
        // Every 64-bit ARM has it.
        #[cfg(target_arch = "aarch64")]
        found.push(Self(Instructions::Neon));
        found.push(Self(Instructions::Scalar));
        found
    }

    /// The fastest that this CPU can run.
    pub fn detect() -> Self {
        Self::available()[0]
    }

    /// Its usual name.
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx512 => "AVX-512",
            #[cfg(target_arch = "x86_64")]
            Instructions::Avx2 => "AVX2",
            #[cfg(target_arch = "aarch64")]
            Instructions::Neon => "NEON",
            Instructions::Scalar => "scalar",
        }
    }

    /// Which set it is.
    pub(super) fn instructions(self) -> Instructions {
        self.0
    }
}
