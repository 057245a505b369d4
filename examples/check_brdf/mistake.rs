//! Mistakes of practice, each found in at least one renderer.

/// One mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mistake {
    None,
    NoJacobianInPdf,
    AlphaForItsSquare,
    AveragedAlphaInG,
    NoJacobianOfClearCoat,
    AnotherAlphaInG,
    NoPiInD,
    WrongHandedness,
    HalfVectorNotFlipped,
    InvertedEta,
    SeparableInWeight,
    ClampedInOnePlace,
}

impl Mistake {
    pub(crate) const ALL: [Self; 11] = [
        Self::NoJacobianInPdf,
        Self::AlphaForItsSquare,
        Self::AveragedAlphaInG,
        Self::NoJacobianOfClearCoat,
        Self::AnotherAlphaInG,
        Self::NoPiInD,
        Self::WrongHandedness,
        Self::HalfVectorNotFlipped,
        Self::InvertedEta,
        Self::SeparableInWeight,
        Self::ClampedInOnePlace,
    ];

    pub(crate) const fn text(self) -> &'static str {
        match self {
            Self::None => "nothing",
            Self::NoJacobianInPdf => "pdf without 1/(4 wo·h)",
            Self::AlphaForItsSquare => "the sampler takes α² for α",
            Self::AveragedAlphaInG => "averaged α in G, beside an anisotropic sampler",
            Self::NoJacobianOfClearCoat => "pdf of a clear coat without its Jacobian",
            Self::AnotherAlphaInG => "eval has G of another α",
            Self::NoPiInD => "D without the 1/π in eval",
            Self::WrongHandedness => "sample in a frame of the other hand",
            Self::HalfVectorNotFlipped => "half vector of transmission not flipped",
            Self::InvertedEta => "η inverted in the half vector of transmission",
            Self::SeparableInWeight => "separable masking in the weight, correlated in eval",
            Self::ClampedInOnePlace => "α clamped in the sampler only",
        }
    }
}
