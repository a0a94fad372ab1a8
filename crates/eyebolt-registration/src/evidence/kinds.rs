//! The list of all kinds of evidence.

use super::kind::{EvidenceKind, Presentation};
use super::outlines::Outlines;
use super::surfaces::Surfaces;
use crate::unknowns::EVIDENCE_KINDS;

/// Every kind; its place here is its place wherever kinds are counted.
pub(crate) static KINDS: [&dyn EvidenceKind; EVIDENCE_KINDS] = [&Surfaces, &Outlines];

/// How each kind is shown, in their order.
pub fn presentation() -> [Presentation; EVIDENCE_KINDS] {
    KINDS.map(EvidenceKind::presentation)
}
