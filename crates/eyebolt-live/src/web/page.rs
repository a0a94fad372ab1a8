//! The page itself, which loads nothing from elsewhere.

use eyebolt::report::STYLE;
use std::hash::{BuildHasher, RandomState};

const PAGE: &str = include_str!("page.html");

/// What a browser may do for the report: what the report itself says, and stand in no frame.
pub(super) const REPORT_POLICY: &str = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; \
    script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The page, whose style and script are marked by `nonce`.
pub(super) fn page(nonce: &str) -> String {
    // The style last: whatever stands in it is not looked at.
    PAGE.replace("%NONCE%", nonce).replace("/* %STYLE% */", STYLE)
}

/// What a browser may do for the page: run what `nonce` marks, and ask here.
pub(super) fn policy(nonce: &str) -> String {
    format!(
        "default-src 'none'; script-src 'nonce-{nonce}'; style-src 'nonce-{nonce}'; img-src blob: data:; \
         connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )
}

/// Letters that nobody can guess and nobody had before.
pub(super) fn nonce() -> String {
    // Hashers are keyed by the system's random numbers, each anew.
    let half = || RandomState::new().hash_one(0_u64);
    format!("{:016x}{:016x}", half(), half())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_complete_and_all_of_it_is_marked() {
        let page = page("0123");
        assert!(!page.contains('%') || !page.contains("%NONCE%") && !page.contains("%STYLE%"));
        // A colour of the report.
        assert!(page.contains("-paper: "));
        for (open, marked) in
            [("<script", "<script nonce=\"0123\">"), ("<style", "<style nonce=\"0123\">")]
        {
            assert_eq!(
                (page.matches(open).count(), page.matches(marked).count()),
                (1, 1),
                "{open}"
            );
        }
        // What the policy forbids, or what would come from elsewhere.
        for bad in [" style=", " onclick=", "http://", "https://", "src=\"/", "innerHTML", "eval("]
        {
            let bare = page.replace("http://www.w3.org/2000/svg", "");
            assert!(!bare.contains(bad), "{bad}");
        }
    }

    #[test]
    fn no_two_are_alike() {
        assert_ne!(nonce(), nonce());
        assert!(nonce().len() == 32 && nonce().bytes().all(|byte| byte.is_ascii_hexdigit()));
    }
}
