//! What names mean where: properties, blocks, macros and namespaces, the inner before the outer.

use super::macros::Macro;
use super::tree::Element;
use super::value::Value;
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// What a property holds.
#[derive(Clone, Debug)]
pub(super) enum Slot {
    Ready(Value),
    /// Text that is evaluated when somebody asks for it.
    Lazy(String),
    /// Being evaluated: who asks for it now goes round in a circle.
    Resolving,
    Block(Block),
}

/// XML that a property or a parameter holds.
#[derive(Clone, Debug)]
pub(super) enum Block {
    /// Of a property: evaluated where it is inserted.
    Source(Rc<Element>),
    /// Of a macro's call: evaluated there.
    Evaluated(Rc<Element>),
}

/// One level of names.
#[derive(Debug, Default)]
pub(super) struct Scope {
    pub(super) slots: RefCell<HashMap<String, Slot>>,
    macros: RefCell<HashMap<String, Rc<Macro>>>,
    namespaces: RefCell<HashMap<String, Rc<Scope>>>,
    outer: Option<Rc<Scope>>,
    is_namespace: bool,
}

impl Scope {
    /// A level within `outer`.
    pub(super) fn within(outer: &Rc<Self>) -> Rc<Self> {
        Rc::new(Self { outer: Some(Rc::clone(outer)), ..Self::default() })
    }

    /// A new namespace called `name`.
    pub(super) fn namespace(self: &Rc<Self>, name: &str) -> Rc<Self> {
        let outer = Some(Rc::clone(self));
        let inner = Rc::new(Self { outer, is_namespace: true, ..Self::default() });
        self.namespaces.borrow_mut().insert(name.to_owned(), Rc::clone(&inner));
        inner
    }

    fn levels(self: &Rc<Self>) -> impl Iterator<Item = Rc<Self>> {
        std::iter::successors(Some(Rc::clone(self)), |scope| scope.outer.clone())
    }

    /// The level that has property `name`, and what it holds.
    pub(super) fn find(self: &Rc<Self>, name: &str) -> Option<(Rc<Self>, Slot)> {
        self.levels().find_map(|scope| {
            let slot = scope.slots.borrow().get(name).cloned();
            slot.map(|slot| (scope, slot))
        })
    }

    pub(super) fn set(&self, name: &str, slot: Slot) {
        self.slots.borrow_mut().insert(name.to_owned(), slot);
    }

    /// Removes property `name` from all levels.
    pub(super) fn remove(self: &Rc<Self>, name: &str) {
        for scope in self.levels() {
            scope.slots.borrow_mut().remove(name);
        }
    }

    pub(super) fn find_namespace(self: &Rc<Self>, name: &str) -> Option<Rc<Self>> {
        self.levels().find_map(|scope| scope.namespaces.borrow().get(name).cloned())
    }

    pub(super) fn define(&self, name: &str, body: Macro) {
        self.macros.borrow_mut().insert(name.to_owned(), Rc::new(body));
    }

    /// The macro called `name`, which may begin with namespaces, and the level that its names are
    /// looked up in.
    pub(super) fn find_macro(self: &Rc<Self>, name: &str) -> Option<(Rc<Self>, Rc<Macro>)> {
        let own = |scope: &Rc<Self>, name: &str| scope.macros.borrow().get(name).cloned();
        if let Some(found) = self.levels().find_map(|scope| own(&scope, name)) {
            return Some((Rc::clone(self), found));
        }
        let (namespaces, name) = name.rsplit_once('.')?;
        let inner = namespaces
            .split('.')
            .try_fold(Rc::clone(self), |scope, namespace| scope.find_namespace(namespace))?;
        own(&inner, name).map(|found| (inner, found))
    }

    /// The outermost level.
    pub(super) fn top(self: &Rc<Self>) -> Rc<Self> {
        self.levels().last().unwrap_or_else(|| Rc::clone(self))
    }

    /// The level of whoever called the macro that this one is of.
    pub(super) fn caller(self: &Rc<Self>) -> Option<Rc<Self>> {
        let within_macro = !self.is_namespace;
        self.levels().skip(1).find(|scope| !(within_macro && scope.is_namespace))
    }
}
