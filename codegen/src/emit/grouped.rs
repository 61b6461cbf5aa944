//! The code of bodies in parts: for each part a loop over the packs of a group, and places for what is kept between them.

use std::collections::BTreeMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::columns::{literal, opened};
use super::expression::Body;
use super::parts::Part;

/// The method of a kernel that goes over columns in parts, each of which goes over a group of packs.
pub(super) fn over_columns(
    body: &Body,
    parts: &[Part],
    [fixed, along]: [&[Ident]; 2],
    counts: &[Literal; 3],
) -> TokenStream {
    let [fixed_count, along_count, results] = counts;
    let opened = opened([(fixed, "fixed"), (along, "columns")]);
    let first = along.first();
    let mut places = Places::default();
    let loops: Vec<TokenStream> = parts
        .iter()
        .map(|part| part_loop(body, part, along, &mut places))
        .collect();
    let kept = literal(places.count);
    let doc = format!(
        " In {} parts, each of which goes over a group of packs before the next one begins.",
        parts.len()
    );
    quote! {
        #[doc = #doc]
        #[inline(always)]
        fn for_each_pack<S: ::lanes::Simd>(
            simd: S,
            fixed: [::lanes::Pack<S>; #fixed_count],
            columns: [&[f64]; #along_count],
            mut take: impl FnMut(usize, [::lanes::Pack<S>; #results]),
        ) {
            #opened
            let mut kept = [::lanes::Kept::empty(simd); #kept];
            let mut groups = ::lanes::Groups::<S>::of(#first.len());
            while let Some(group) = groups.next() {
                #(#loops)*
            }
        }
    }
}

/// The loop of a part over the packs of a group. The last part hands the results on.
fn part_loop(body: &Body, part: &Part, columns: &[Ident], places: &mut Places) -> TokenStream {
    let statements = &body.statements[part.statements.clone()];
    let loads = part.takes.iter().map(|name| {
        let ident = format_ident!("{name}");
        if columns.contains(&ident) {
            return quote!(let #ident = group.load(simd, #ident, pack););
        }
        let place = literal(places.of(name));
        quote!(let #ident = kept[#place].get(pack);)
    });
    let loads: Vec<TokenStream> = loads.collect();
    part.ends.iter().for_each(|name| places.free(name));
    let stores: Vec<TokenStream> = part
        .gives
        .iter()
        .map(|name| {
            let place = literal(places.take(name));
            let name = format_ident!("{name}");
            quote!(kept[#place].set(pack, #name);)
        })
        .collect();
    let outputs = &body.outputs;
    let taken = part
        .is_last
        .then(|| quote!(take(group.row(pack), [#(#outputs),*]);));
    quote! {
        for pack in group.packs() {
            #(#loads)*
            #(#statements)*
            #(#stores)*
            #taken
        }
    }
}

/// Which number is kept where: a place is free again after the last part that takes its number.
#[derive(Default)]
struct Places {
    taken: BTreeMap<String, usize>,
    free: Vec<usize>,
    count: usize,
}

impl Places {
    /// The place of a number that is kept. Of one that is not, which were a mistake of the cuts, it is a place that no array has:
    /// the compiler refuses that, where another place would be another number.
    fn of(&self, name: &str) -> usize {
        self.taken.get(name).copied().unwrap_or(usize::MAX)
    }

    /// Takes a place for a number.
    fn take(&mut self, name: &str) -> usize {
        let place = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.taken.insert(name.to_owned(), place);
        place
    }

    /// Gives the place of a number back.
    fn free(&mut self, name: &str) {
        self.free.extend(self.taken.remove(name));
    }
}
