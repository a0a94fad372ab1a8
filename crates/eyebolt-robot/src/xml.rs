//! Attributes of XML elements as typed values, with the line in every complaint.

use crate::error::RobotError;
use roxmltree::{Document, Node, ParsingOptions};
use std::borrow::Cow;

/// Most elements, attributes and texts of one document: memory stays near the size of the file.
const MAX_NODES: u32 = 20_000_000;

/// More prefixes than this are not declared one by one.
const MOST_UNDECLARED: usize = 32;

/// `text` with the prefixes declared that it uses and does not declare, as `drake:` in what some
/// exporters write: elements of another program, which others pass over. Lines stay as they are.
pub(crate) fn with_declared_prefixes(text: &str) -> Cow<'_, str> {
    let mut declared = Cow::Borrowed(text);
    for _ in 0..MOST_UNDECLARED {
        let Err(roxmltree::Error::UnknownNamespace(prefix, _)) =
            Document::parse_with_options(&declared, options())
        else {
            break;
        };
        let Some(at) = end_of_root_name(&declared) else { break };
        let mut whole = declared.into_owned();
        whole.insert_str(at, &format!(" xmlns:{prefix}=\"undeclared:{prefix}\""));
        declared = Cow::Owned(whole);
    }
    declared
}

/// Where the name of the outermost element ends, after declaration, comments and instructions.
fn end_of_root_name(text: &str) -> Option<usize> {
    let mut at = 0;
    loop {
        at += text.get(at..)?.find('<')?;
        let rest = text.get(at..)?;
        let end = match rest {
            _ if rest.starts_with("<!--") => rest.find("-->")?,
            _ if rest.starts_with("<?") => rest.find("?>")?,
            _ => {
                let name = rest.find(|c: char| c.is_whitespace() || matches!(c, '>' | '/'))?;
                return Some(at + name);
            }
        };
        at += end;
    }
}

fn options<'i>() -> ParsingOptions<'i> {
    ParsingOptions { allow_dtd: false, nodes_limit: MAX_NODES, ..Default::default() }
}

/// Parses plain XML: no DOCTYPE, hence no entities of the document's own.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, (String, &'static str)> {
    Document::parse_with_options(text, options()).map_err(|error| {
        let remedy = match error {
            roxmltree::Error::DtdDetected => {
                "remove the DOCTYPE and write out the entities that it defines"
            }
            roxmltree::Error::UnknownEntityReference(..) => "write out the entity",
            _ => "correct the XML there or export the file again",
        };
        (error.to_string(), remedy)
    })
}

/// First child called `name`, in any namespace.
pub(crate) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|child| child.tag_name().name() == name)
}

/// An element of a URDF and the words that messages use for it.
#[derive(Clone)]
pub(crate) struct Element<'a, 'input> {
    pub(crate) node: Node<'a, 'input>,
    pub(crate) file: &'a str,
    /// Such as "link `wrist`, visual".
    pub(crate) context: String,
}

impl<'a, 'input> Element<'a, 'input> {
    /// The error of `field` with this element's line.
    pub(crate) fn error(&self, field: &str, problem: impl Into<String>) -> RobotError {
        let line = self.node.document().text_pos_at(self.node.range().start).row;
        let field = if field.is_empty() {
            self.context.clone()
        } else {
            format!("{}, {field}", self.context)
        };
        RobotError::Field { file: self.file.to_owned(), line, field, problem: problem.into() }
    }

    /// Child elements called `name`, in the namespace of this element.
    pub(crate) fn children(&self, name: &'static str) -> impl Iterator<Item = Self> {
        let namespace = self.node.tag_name().namespace();
        self.node
            .children()
            .filter(move |child| {
                child.tag_name().name() == name && child.tag_name().namespace() == namespace
            })
            .map(move |node| self.around(node))
    }

    /// The only child element called `name`.
    pub(crate) fn child(&self, name: &'static str) -> Result<Option<Self>, RobotError> {
        let mut children = self.children(name);
        let first = children.next();
        match children.next() {
            Some(second) => Err(second.error("", format!("a second <{name}>; keep one"))),
            None => Ok(first),
        }
    }

    /// The only child element called `name`, which must be there.
    pub(crate) fn required_child(&self, name: &'static str) -> Result<Self, RobotError> {
        self.child(name)?.ok_or_else(|| self.error("", format!("no <{name}>; add one")))
    }

    /// This context around another node, with its tag.
    pub(crate) fn around(&self, node: Node<'a, 'input>) -> Self {
        let context = format!("{}, <{}>", self.context, node.tag_name().name());
        Self { node, file: self.file, context }
    }

    /// Text of attribute `name`, which must be there.
    pub(crate) fn required(&self, name: &str) -> Result<&'a str, RobotError> {
        self.node.attribute(name).ok_or_else(|| self.error(name, "missing; add the attribute"))
    }

    /// Number in attribute `name`, if it is there.
    pub(crate) fn number(&self, name: &str) -> Result<Option<f64>, RobotError> {
        Ok(self.numbers::<1>(name)?.map(|[number]| number))
    }

    /// Number in attribute `name`, above zero.
    pub(crate) fn positive(&self, name: &str) -> Result<f64, RobotError> {
        let text = self.required(name)?;
        match self.number(name)? {
            Some(number) if number > 0.0 => Ok(number),
            _ => Err(self.error(name, format!("`{text}`; write a length in metres above zero"))),
        }
    }

    /// `N` finite numbers in attribute `name`, if it is there.
    pub(crate) fn numbers<const N: usize>(
        &self,
        name: &str,
    ) -> Result<Option<[f64; N]>, RobotError> {
        let Some(text) = self.node.attribute(name) else { return Ok(None) };
        let parsed = text.split_whitespace().map(str::parse::<f64>).collect::<Result<Vec<_>, _>>();
        parsed
            .ok()
            .filter(|numbers| numbers.iter().all(|number| number.is_finite()))
            .and_then(|numbers| <[f64; N]>::try_from(numbers).ok())
            .map(Some)
            .ok_or_else(|| {
                let plural = if N == 1 { "" } else { "s" };
                self.error(name, format!("`{text}`; write {N} finite number{plural}"))
            })
    }
}
