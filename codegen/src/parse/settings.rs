//! What a module takes over of those that it links: how large its numbers are, where they lie, how names are typeset.

use std::rc::Rc;

use super::attributes::of_module::{Link, ModuleAttribute};
use super::module::Module;
use crate::diagnostics::Diagnostics;
use crate::graph::{Domain, Sizes};
use crate::symbols::Symbols;

/// Gives a module the settings that its attribute states, and of those that it does not state the ones of the modules that
/// it links. Where two of these say different things of sizes or of the domain of one name, that is reported: the module
/// has to state it. Of two symbols for one name that of the module which is linked first is taken.
pub(super) fn settle(
    module: &mut Module,
    attribute: &ModuleAttribute,
    links: &[(&Link, Rc<Module>)],
    diagnostics: &mut Diagnostics,
) {
    module.symbols = Symbols::read(&attribute.latex, diagnostics);
    for (_, linked) in links {
        module.symbols.take_over(&linked.symbols);
    }
    let stated = attribute.domain.iter();
    let stated: Vec<(String, Domain)> = stated
        .map(|(target, domain)| (target.symbol.clone(), *domain))
        .collect();
    module.domain = stated.clone();
    module.sizes = attribute.sizes;
    let mut taken: Vec<(String, Domain)> = Vec::new();
    for (link, linked) in links {
        let mut differs = |what: &str| {
            diagnostics.error_with_hint(
                link.span(),
                format!(
                    "`{}` says another thing of {what} than a module linked before it",
                    link.place.text()
                ),
                "say here what holds in this module",
            );
        };
        if attribute.sizes == Sizes::All && linked.sizes != Sizes::All {
            if module.sizes != Sizes::All && module.sizes != linked.sizes {
                differs("the sizes of numbers");
            }
            module.sizes = linked.sizes;
        }
        for (name, domain) in domains(&linked.domain) {
            if stated.iter().any(|(known, _)| *known == name) {
                continue;
            }
            match taken.iter().find(|(known, _)| *known == name) {
                None => taken.push((name, domain)),
                Some((_, known)) if *known == domain => {}
                Some(_) => differs(&format!("`{name}`")),
            }
        }
    }
    module.domain.extend(taken);
}

/// Each name once, with all that is said of it.
fn domains(said: &[(String, Domain)]) -> Vec<(String, Domain)> {
    let mut all: Vec<(String, Domain)> = Vec::new();
    for (name, domain) in said {
        match all.iter_mut().find(|(known, _)| known == name) {
            Some((_, known)) => *known = known.and(*domain),
            None => all.push((name.clone(), *domain)),
        }
    }
    all
}
