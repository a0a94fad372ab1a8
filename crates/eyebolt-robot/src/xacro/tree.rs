//! XML as a tree of its own, to be read, rewritten and written.

use super::error::Fault;
use crate::xml;
use roxmltree::{Document, Node as XmlNode};
use std::fmt::Write;
use std::rc::Rc;

/// Deepest nesting of elements.
const MAX_DEPTH: usize = 200;

#[derive(Clone, Debug)]
pub(super) enum Node {
    Element(Element),
    Text(String),
}

/// An element; names have their prefix, which is `xacro` whatever the file calls that.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) attributes: Vec<(String, String)>,
    pub(super) children: Vec<Node>,
    pub(super) file: Rc<str>,
    pub(super) line: u32,
}

impl Element {
    /// Nothing, in a place that messages name.
    pub(super) fn empty_like(other: &Self, name: &str) -> Self {
        let (name, file) = (name.to_owned(), Rc::clone(&other.file));
        Self { name, attributes: Vec::new(), children: Vec::new(), file, line: other.line }
    }

    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }

    pub(super) fn required(&self, name: &str) -> Result<&str, Fault> {
        let missing = || Fault::new(format!("<{}> has no {name}; add the attribute", self.name));
        self.attribute(name).ok_or_else(missing)
    }

    pub(super) fn set(&mut self, name: &str, value: String) {
        match self.attributes.iter_mut().find(|(known, _)| known == name) {
            Some((_, known)) => *known = value,
            None => self.attributes.push((name.to_owned(), value)),
        }
    }

    pub(super) fn elements(&self) -> impl Iterator<Item = &Self> {
        self.children.iter().filter_map(|child| match child {
            Node::Element(element) => Some(element),
            Node::Text(_) => None,
        })
    }

    /// As XML.
    pub(super) fn to_xml(&self) -> String {
        let mut text = String::from("<?xml version=\"1.0\"?>\n");
        self.write(&mut text, 0);
        text
    }

    fn write(&self, text: &mut String, depth: usize) {
        let (indent, name) = ("  ".repeat(depth), &self.name);
        // Writing to a string cannot fail.
        let _ = write!(text, "{indent}<{name}");
        for (name, value) in &self.attributes {
            let _ = write!(text, " {name}=\"{}\"", escaped(value).replace('"', "&quot;"));
        }
        let shown = |node: &&Node| match node {
            Node::Element(_) => true,
            Node::Text(text) => !text.trim().is_empty(),
        };
        let mut children = self.children.iter().filter(shown).peekable();
        if children.peek().is_none() {
            let _ = writeln!(text, "/>");
            return;
        }
        let _ = writeln!(text, ">");
        for child in children {
            match child {
                Node::Element(element) => element.write(text, depth + 1),
                Node::Text(content) => {
                    let _ = writeln!(text, "{indent}  {}", escaped(content.trim()));
                }
            }
        }
        let _ = writeln!(text, "{indent}</{name}>");
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn is_of_xacro(namespace: Option<&str>) -> bool {
    namespace.is_some_and(|namespace| namespace.contains("xacro"))
}

/// Whether a document has elements of xacro.
pub(crate) fn is_xacro(document: &Document<'_>) -> bool {
    let mut nodes = document.root_element().descendants();
    nodes.any(|node| is_of_xacro(node.tag_name().namespace()))
}

/// The outermost element of `text`, which is in `file`.
pub(super) fn parse(text: &str, file: &Rc<str>) -> Result<Element, Fault> {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let declared = xml::with_declared_prefixes(text);
    let document = xml::parse(&declared).map_err(|(problem, remedy)| {
        Fault::new(format!("not plain XML: {problem}; {remedy}")).at(file, 1)
    })?;
    element(document.root_element(), file, 0)
}

fn element(node: XmlNode<'_, '_>, file: &Rc<str>, depth: usize) -> Result<Element, Fault> {
    let line = node.document().text_pos_at(node.range().start).row;
    if depth > MAX_DEPTH {
        return Err(Fault::new("elements are nested too deep").at(file, line));
    }
    let qualified = |namespace: Option<&str>, name: &str| {
        let prefix = match namespace {
            None => None,
            Some(_) if is_of_xacro(namespace) => Some("xacro"),
            Some(namespace) => node.lookup_prefix(namespace).filter(|prefix| !prefix.is_empty()),
        };
        prefix.map_or_else(|| name.to_owned(), |prefix| format!("{prefix}:{name}"))
    };
    let attributes = node.attributes().map(|attribute| {
        (qualified(attribute.namespace(), attribute.name()), attribute.value().to_owned())
    });
    let children = node.children().filter_map(|child| {
        if child.is_element() {
            return Some(element(child, file, depth + 1).map(Node::Element));
        }
        child.text().filter(|_| child.is_text()).map(|text| Ok(Node::Text(text.to_owned())))
    });
    Ok(Element {
        name: qualified(node.tag_name().namespace(), node.tag_name().name()),
        attributes: attributes.collect(),
        children: children.collect::<Result<_, _>>()?,
        file: Rc::clone(file),
        line,
    })
}
