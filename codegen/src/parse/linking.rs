//! Modules that link each other, read so that each knows those that it links.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use proc_macro2::TokenStream;
use syn::ItemMod;

use super::attributes::of_module::{Link, ModuleAttribute};
use super::module::Module;
use super::names::Linked;
use super::place::Place;
use super::settings;
use crate::diagnostics::{Diagnostics, nearest};

/// A module as it is written.
#[derive(Clone, Debug)]
pub struct Source {
    /// What tells it from the others.
    pub key: String,
    /// What stands in the parentheses of its attribute.
    pub attribute: TokenStream,
    /// Its item.
    pub item: ItemMod,
    /// Where it is: all paths at which others find it.
    pub places: Vec<Place>,
}

/// Modules that link each other.
#[derive(Debug, Default)]
pub struct Sources {
    modules: Vec<Source>,
    /// Those that were read for others; none while a module is being read, so that a circle ends.
    read: BTreeMap<usize, Option<Rc<Module>>>,
}

impl Sources {
    /// Sources of which each is read when it is asked for.
    pub fn new(modules: Vec<Source>) -> Self {
        let read = BTreeMap::new();
        Self { modules, read }
    }

    /// Reads one of them; what is wrong in it is reported, what is wrong in those that it links is not: they report it
    /// themselves.
    pub fn module(&mut self, position: usize, diagnostics: &mut Diagnostics) -> Option<Module> {
        let Source {
            key,
            attribute,
            item,
            ..
        } = self.modules.get(position)?.clone();
        let attribute = ModuleAttribute::read(attribute, diagnostics);
        let (mut links, mut refused) = (Vec::new(), Vec::new());
        for link in &attribute.links {
            let Some(target) = self.target(position, link) else {
                self.report_unknown(link, diagnostics);
                refused.push(link.place.clone());
                continue;
            };
            if let Some(circle) = self.way(target, position) {
                report_circle(link, &circle, diagnostics);
                refused.push(link.place.clone());
            } else if let Some(module) = self.known(target) {
                links.push((link, module));
            }
        }
        let linked = all_linked(&links);
        let mut module = Module::read_among(key, linked, item, diagnostics);
        module.refused = refused;
        module.has_chain = attribute.chain;
        settings::settle(&mut module, &attribute, &links, diagnostics);
        Some(module)
    }

    /// One of them, read for others.
    fn known(&mut self, position: usize) -> Option<Rc<Module>> {
        if let Some(known) = self.read.get(&position) {
            return known.clone();
        }
        self.read.insert(position, None);
        let module = self.module(position, &mut Diagnostics::default());
        let module = module.map(Rc::new);
        self.read.insert(position, module.clone());
        module
    }

    fn target(&self, from: usize, link: &Link) -> Option<usize> {
        let source = self.modules.get(from)?;
        let around = source.places.first()?.around(&source.item.ident);
        let place = around.join(&link.place);
        let mut modules = self.modules.iter();
        modules.position(|other| other.places.contains(&place))
    }

    /// The links that lead from one module to another, the other's own name last.
    fn way(&self, from: usize, to: usize) -> Option<Vec<String>> {
        let mut seen = BTreeSet::new();
        let mut open = vec![(from, Vec::new())];
        while let Some((position, way)) = open.pop() {
            if position == to {
                return Some(way);
            }
            let Some(source) = self.modules.get(position).filter(|_| seen.insert(position)) else {
                continue;
            };
            let mut unread = Diagnostics::default();
            let attribute = ModuleAttribute::read(source.attribute.clone(), &mut unread);
            for link in &attribute.links {
                if let Some(target) = self.target(position, link) {
                    let mut further = way.clone();
                    further.push(link.place.text());
                    open.push((target, further));
                }
            }
        }
        None
    }

    fn report_unknown(&self, link: &Link, diagnostics: &mut Diagnostics) {
        let places = self.modules.iter().flat_map(|source| &source.places);
        let names: Vec<&str> = places.filter_map(Place::last).collect();
        let meant = link.place.last().and_then(|name| nearest(name, names));
        diagnostics.error_with_hint(
            link.span(),
            format!("`{}` is no module of formulas", link.place.text()),
            match meant {
                Some(name) => format!("did you mean `{name}`?"),
                None => "link a module that has the attribute, or the module around it".to_owned(),
            },
        );
    }
}

fn report_circle(link: &Link, circle: &[String], diagnostics: &mut Diagnostics) {
    let way = std::iter::once(link.place.text()).chain(circle.iter().cloned());
    let way: Vec<String> = way.map(|place| format!("`{place}`")).collect();
    diagnostics.error_with_hint(
        link.span(),
        format!("this module links itself: {}", way.join(" → ")),
        "put the formulas that both need into a module that both link",
    );
}

/// The modules that are linked, each at its path, and those that they link, at the paths at which this one finds them.
fn all_linked(links: &[(&Link, Rc<Module>)]) -> Vec<Linked> {
    let direct = links.iter().map(|(link, module)| Linked {
        place: link.place.clone(),
        module: Rc::clone(module),
    });
    let mut all: Vec<Linked> = direct.collect();
    for (link, module) in links {
        let around = link.place.around(&module.item.ident);
        for further in &module.linked {
            let place = around.join(&further.place);
            if all.iter().all(|known| known.place != place) {
                let module = Rc::clone(&further.module);
                all.push(Linked { place, module });
            }
        }
    }
    all
}
