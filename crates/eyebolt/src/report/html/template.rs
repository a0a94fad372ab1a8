//! Templates into a page.

use super::svg::signed;
use minijinja::{AutoEscape, Environment, UndefinedBehavior, Value};

/// How the pages look: colours for both colour schemes by name, and classes.
pub const STYLE: &str = include_str!("style.css");

/// Texts that stand in the page as they are, and those that are filled in.
const FILES: [(&str, &str); 13] = [
    ("base.html", include_str!("base.html")),
    ("page.html", include_str!("page.html")),
    ("verdict.html", include_str!("verdict.html")),
    ("transform.html", include_str!("transform.html")),
    ("scene.html", include_str!("scene.html")),
    ("accuracy.html", include_str!("accuracy.html")),
    ("fit.html", include_str!("fit.html")),
    ("made.html", include_str!("made.html")),
    ("batch.html", include_str!("batch.html")),
    ("tables.html", include_str!("tables.html")),
    ("style.css", STYLE),
    ("page.js", include_str!("page.js")),
    ("view.js", include_str!("view.js")),
];

/// The page that `context` makes of the template called `name`.
pub(super) fn render(name: &str, context: Value) -> String {
    let mut environment = Environment::new();
    // All of them, so that nothing depends on what a file is called.
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    // Of the answer, what it leaves out of its file may be asked for, but not shown.
    environment.set_undefined_behavior(UndefinedBehavior::SemiStrict);
    // A number that nobody has is a dash: `none` is a word of programs.
    environment.set_formatter(|out, state, value| match value.is_none() {
        true => out.write_str("–").map_err(minijinja::Error::from),
        false => minijinja::escape_formatter(out, state, value),
    });
    environment.add_filter("fixed", |value: f64, decimals: usize| format!("{value:.decimals$}"));
    environment.add_filter("signed", signed);
    let column = |value: f64, width: usize, decimals: usize| format!("{value:>width$.decimals$}");
    environment.add_filter("column", column);
    for (name, text) in FILES {
        environment.add_template(name, text).expect("a template of ours is well formed");
    }
    let page = environment.get_template(name).expect("it is one of them");
    page.render(context).expect("every page has what its templates name")
}
