//! A xacro file into the URDF that it stands for.

use super::error::Fault;
use super::literal::{literal, truth};
use super::macros::{Macro, parameters};
use super::scope::{Block, Scope, Slot};
use super::text::{Outside, evaluate, property};
use super::tree::{Element, Node, parse};
use super::value::Value;
use super::yaml;
use crate::error::RobotError;
use crate::input::Input;
use crate::packages::PackageRoots;
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// Longest file that is included, bytes.
const MAX_BYTES: u64 = 64 << 20;
/// Deepest nesting of macros, includes and elements.
const MAX_DEPTH: usize = 300;
/// Most elements that are looked at: a macro may call itself.
const MAX_ELEMENTS: u64 = 2_000_000;

/// Values of the arguments of a xacro file, by name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct XacroArguments(BTreeMap<String, String>);

impl FromIterator<(String, String)> for XacroArguments {
    fn from_iter<I: IntoIterator<Item = (String, String)>>(pairs: I) -> Self {
        Self(pairs.into_iter().collect())
    }
}

impl XacroArguments {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// The URDF that `text`, of the file at `path`, stands for.
pub(crate) fn expand(
    path: &Path,
    text: &str,
    packages: &PackageRoots,
    arguments: &XacroArguments,
) -> Result<String, RobotError> {
    let expansion = Expansion {
        packages,
        arguments: RefCell::new(arguments.0.clone()),
        files: RefCell::new(vec![path.to_owned()]),
        elements: Cell::new(0),
        depth: Cell::new(0),
    };
    let file: Rc<str> = path.display().to_string().into();
    expansion.whole(text, &file).map_err(|fault| {
        let (file, line) = fault.place.unwrap_or((file.to_string(), 1));
        RobotError::Xacro { file, line, problem: fault.problem }
    })
}

struct Expansion<'e> {
    packages: &'e PackageRoots,
    arguments: RefCell<BTreeMap<String, String>>,
    /// Files being read, the innermost last.
    files: RefCell<Vec<PathBuf>>,
    elements: Cell<u64>,
    depth: Cell<usize>,
}

type Done = Result<(), Fault>;

impl Expansion<'_> {
    fn whole(&self, text: &str, file: &Rc<str>) -> Result<String, Fault> {
        let root = parse(text, file)?;
        let mut out = Element::empty_like(&root, &root.name);
        let scope = Rc::new(Scope::default());
        self.plain(&root, &scope, &mut out)?;
        Ok(out.to_xml())
    }

    /// An element that means itself: attributes and content into `out`.
    fn plain(&self, element: &Element, scope: &Rc<Scope>, out: &mut Element) -> Done {
        let of_xacro = |name: &str| name.starts_with("xacro:");
        for (name, value) in element.attributes.iter().filter(|(name, _)| !of_xacro(name)) {
            let value =
                evaluate(value, scope, self).map_err(|f| f.at(&element.file, element.line))?;
            out.set(name, value.to_string());
        }
        self.content(element, scope, out)
    }

    /// What `element` contains, evaluated, at the end of `out`.
    fn content(&self, element: &Element, scope: &Rc<Scope>, out: &mut Element) -> Done {
        self.depth.set(self.depth.get() + 1);
        if self.depth.get() > MAX_DEPTH {
            let problem =
                "macros, includes or elements are nested too deep; does one contain itself?";
            return Err(Fault::new(problem).at(&element.file, element.line));
        }
        for child in &element.children {
            match child {
                Node::Text(text) => {
                    let text = evaluate(text, scope, self);
                    let text = text.map_err(|f| f.at(&element.file, element.line))?;
                    out.children.push(Node::Text(text.to_string()));
                }
                Node::Element(child) => {
                    self.element(child, scope, out).map_err(|f| f.at(&child.file, child.line))?;
                }
            }
        }
        self.depth.set(self.depth.get() - 1);
        Ok(())
    }

    fn element(&self, element: &Element, scope: &Rc<Scope>, out: &mut Element) -> Done {
        self.elements.set(self.elements.get() + 1);
        if self.elements.get() > MAX_ELEMENTS {
            return Err("too many elements; does a macro call itself?".into());
        }
        let text = |text: &str| Ok::<_, Fault>(evaluate(text, scope, self)?.to_string());
        let Some(name) = element.name.strip_prefix("xacro:") else {
            let mut copy = Element::empty_like(element, &element.name);
            self.plain(element, scope, &mut copy)?;
            out.children.push(Node::Element(copy));
            return Ok(());
        };
        match name {
            "property" => self.property(element, scope),
            "macro" => {
                let name = element.required("name")?.trim_start_matches("xacro:");
                let parameters = parameters(element.attribute("params").unwrap_or_default());
                scope.define(name, Macro { parameters, body: Rc::new(element.clone()) });
                Ok(())
            }
            "arg" => {
                let (name, default) = (element.required("name")?, element.required("default")?);
                if !self.arguments.borrow().contains_key(name) {
                    let value = text(default)?;
                    self.arguments.borrow_mut().insert(name.to_owned(), value);
                }
                Ok(())
            }
            "include" => self.include(element, scope, out),
            "if" | "unless" => {
                let condition = element.required("value")?;
                let holds = truth(&evaluate(condition, scope, self)?, condition)?;
                if holds == (name == "if") { self.content(element, scope, out) } else { Ok(()) }
            }
            "insert_block" => self.insert(&text(element.required("name")?)?, scope, out),
            "element" => {
                let name = text(element.required("xacro:name")?)?;
                let mut copy = Element::empty_like(element, &name);
                self.plain(element, scope, &mut copy)?;
                out.children.push(Node::Element(copy));
                Ok(())
            }
            "attribute" => {
                let (name, value) = (element.required("name")?, element.required("value")?);
                out.set(&text(name)?, text(value)?);
                Ok(())
            }
            "call" => self.call(&text(element.required("macro")?)?, element, scope, out),
            name => self.call(name, element, scope, out),
        }
    }

    fn property(&self, element: &Element, scope: &Rc<Scope>) -> Done {
        let name = evaluate(element.required("name")?, scope, self)?.to_string();
        let truth_of = |attribute: &str, otherwise: bool| match element.attribute(attribute) {
            Some(text) => truth(&evaluate(text, scope, self)?, text),
            None => Ok(otherwise),
        };
        if truth_of("remove", false)? {
            scope.remove(&name);
            return Ok(());
        }
        let default = element.attribute("default");
        if default.is_some() && scope.find(&name).is_some() {
            return Ok(());
        }
        let Some(value) = element.attribute("value").or(default) else {
            let block = Block::Source(Rc::new(element.clone()));
            scope.set(&format!("**{name}"), Slot::Block(block));
            return Ok(());
        };
        let (level, lazy) = match element.attribute("scope") {
            Some("global") => (scope.top(), false),
            Some("parent") => match scope.caller() {
                Some(caller) => (caller, false),
                None => return Ok(()),
            },
            _ => (Rc::clone(scope), truth_of("lazy_eval", true)?),
        };
        let slot = match lazy {
            true => match literal(value) {
                Value::Text(text) => Slot::Lazy(text.to_string()),
                other => Slot::Ready(other),
            },
            false => Slot::Ready(typed(evaluate(value, scope, self)?)),
        };
        level.set(&name, slot);
        Ok(())
    }

    fn include(&self, element: &Element, scope: &Rc<Scope>, out: &mut Element) -> Done {
        let name = evaluate(element.required("filename")?, scope, self)?.to_string();
        let path = PathBuf::from(self.path(&name));
        let optional = element.attribute("optional").is_some_and(|text| text == "true");
        let text = match read(&path) {
            Err(_) if optional => return Ok(()),
            read => read?,
        };
        let inner = match element.attribute("ns") {
            Some(namespace) => scope.namespace(&evaluate(namespace, scope, self)?.to_string()),
            None => Rc::clone(scope),
        };
        let file: Rc<str> = path.display().to_string().into();
        let root = parse(&text, &file)?;
        self.files.borrow_mut().push(path);
        self.content(&root, &inner, out)?;
        self.files.borrow_mut().pop();
        Ok(())
    }

    fn insert(&self, name: &str, scope: &Rc<Scope>, out: &mut Element) -> Done {
        let find = |stars: &str| scope.find(&format!("{stars}{name}")).map(|(_, slot)| slot);
        match (find("**"), find("*")) {
            (Some(Slot::Block(Block::Source(block))), _) => self.content(&block, scope, out),
            (Some(Slot::Block(Block::Evaluated(block))), _) => {
                out.children.extend(block.children.iter().cloned());
                Ok(())
            }
            (_, Some(Slot::Block(Block::Evaluated(block) | Block::Source(block)))) => {
                out.children.push(Node::Element(block.as_ref().clone()));
                Ok(())
            }
            _ => Err(format!("there is no block `{name}`; give it to the macro").into()),
        }
    }

    fn call(&self, name: &str, node: &Element, scope: &Rc<Scope>, out: &mut Element) -> Done {
        let (level, called) = scope.find_macro(name).ok_or_else(|| {
            Fault::new(format!("there is no macro `{name}`; include the file that defines it"))
        })?;
        let inner = Scope::within(&level);
        let mut waiting = called.parameters.clone();
        let dynamic = node.name == "xacro:call";
        for (given, value) in &node.attributes {
            if dynamic && given == "macro" {
                continue;
            }
            let Some(at) = waiting.iter().position(|parameter| parameter.name == *given) else {
                return Err(format!("macro `{name}` has no parameter `{given}`; remove it").into());
            };
            waiting.remove(at);
            inner.set(given, Slot::Ready(typed(evaluate(value, scope, self)?)));
        }
        let mut blocks = Element::empty_like(node, "blocks");
        self.content(node, scope, &mut blocks)?;
        let mut blocks = blocks.elements();
        for parameter in waiting {
            let slot = if parameter.name.starts_with('*') {
                let missing =
                    || Fault::new(format!("macro `{name}`: block `{}` is missing", parameter.name));
                let block = blocks.next().cloned().ok_or_else(missing)?;
                Slot::Block(Block::Evaluated(Rc::new(block)))
            } else {
                let outer = match parameter.forwards {
                    true => property(&parameter.name, scope, self)?,
                    false => None,
                };
                let value = match (outer, &parameter.default) {
                    (Some(value), _) => value,
                    (None, Some(default)) => evaluate(default, scope, self)?,
                    (None, None) => {
                        let problem = format!("macro `{name}` needs `{}`; give it", parameter.name);
                        return Err(problem.into());
                    }
                };
                Slot::Ready(typed(value))
            };
            inner.set(&parameter.name, slot);
        }
        if let Some(block) = blocks.next() {
            return Err(format!("macro `{name}` takes no block <{}>; remove it", block.name).into());
        }
        self.content(&called.body, &inner, out)
    }
}

/// A value whose text stands for a number or a truth is that.
fn typed(value: Value) -> Value {
    match value {
        Value::Text(text) => literal(&text),
        other => other,
    }
}

fn read(path: &Path) -> Result<String, Fault> {
    use std::io::Read;
    let failed = |error: std::io::Error| {
        Fault::new(format!("cannot read {}: {error}; correct the path", path.display()))
    };
    let file = std::fs::File::open(path).map_err(failed)?;
    let mut text = String::new();
    file.take(MAX_BYTES).read_to_string(&mut text).map_err(failed)?;
    Ok(text)
}

impl Outside for Expansion<'_> {
    fn extension(&self, command: &str, rest: &str) -> Result<String, Fault> {
        let stated = |name: &str| self.arguments.borrow().get(name).cloned();
        let argument = Input::XACRO_ARGUMENT;
        match command {
            "arg" => stated(rest).ok_or_else(|| {
                Fault::new(format!(
                    "`$(arg {rest})` has no value; give it with {argument} {rest}=VALUE"
                ))
            }),
            "find" => {
                let files = self.files.borrow();
                let folder = files.first().and_then(|path| path.parent()).map(absolute);
                self.packages.package(rest, folder.as_deref()).ok_or_else(|| {
                    let folder = Input::PACKAGE_PATH;
                    let problem = format!("there is no package `{rest}`");
                    Fault::new(format!("{problem}; give its folder with {folder} {rest}=FOLDER"))
                })
            }
            // The environment is not read: the same file is the same robot everywhere.
            "env" => stated(&format!("env:{rest}")).ok_or_else(|| {
                let problem = format!("`$(env {rest})` is not read from the environment");
                Fault::new(format!("{problem}; give it with {argument} env:{rest}=VALUE"))
            }),
            "optenv" => {
                let (name, default) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
                Ok(stated(&format!("env:{name}")).unwrap_or_else(|| default.trim().to_owned()))
            }
            "dirname" | "cwd" => Ok(self.path("").trim_end_matches('/').to_owned()),
            other => Err(format!("`$({other} ...)` is not understood; write its value").into()),
        }
    }

    fn yaml(&self, file: &str) -> Result<Value, Fault> {
        let path = self.path(file);
        let text = read(Path::new(&path))?;
        yaml::parse(&text).map_err(|fault| fault.at(&path, 1))
    }

    fn path(&self, file: &str) -> String {
        let files = self.files.borrow();
        let folder = files.last().and_then(|path| path.parent()).map(absolute).unwrap_or_default();
        folder.join(file).display().to_string()
    }
}

fn absolute(folder: &Path) -> PathBuf {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned())
}
