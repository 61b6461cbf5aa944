//! The chain of a module as code: its columns, and for each formula what it takes and gives and the kernels that do it.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::columns::literal;
use crate::chain::{Chain, Link, StagedMember};

/// The module `chain`; `imports` bring the formulas of other modules into it.
pub fn module(chain: &Chain, imports: &[TokenStream]) -> TokenStream {
    let column = columns(chain);
    let of_stages = " A formula that gives what others take.";
    let stages = links("Stage", of_stages, &chain.stages, chain);
    let of_results = " A formula that gives results.";
    let formulas = links("Formula", of_results, &chain.formulas, chain);
    let staged = staged(chain);
    let structures = structures(chain);
    quote! {
        /// From the inputs to every result, formula by formula: what each takes, gives and depends on, and the kernels that
        /// compute it.
        #[allow(clippy::all, clippy::pedantic, unused)]
        pub mod chain {
            use super::*;
            #(#imports)*

            #column
            #stages
            #formulas
            #staged
            #(#structures)*
        }
    }
}

/// What a member costs, in the module of its forms: its column form a row, 0 without one, and each of its staged forms for
/// every value of what runs along and at every point. The chain may be in another module.
pub fn weights(rows: Option<usize>, staged: &[[usize; 2]]) -> TokenStream {
    let (row, count) = (literal(rows.unwrap_or_default()), literal(staged.len()));
    let staged = staged.iter().map(|weights| {
        let weights = weights.map(literal);
        quote!([#(#weights),*])
    });
    quote! {
        /// What a row of `columns` costs, in additions; 0 where there are none.
        pub const WEIGHT: usize = #row;
        /// What each staged form costs for every value of what runs along, and at every point, in additions.
        pub const STAGED_WEIGHTS: [[usize; 2]; #count] = [#(#staged),*];
    }
}

/// `k_tt` as the name of a variant, `KTt`.
fn variant(name: &str) -> Ident {
    let capital = |word: &str| {
        let mut letters = word.chars();
        let first = letters.next().map(|letter| letter.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    };
    let name: String = name.split('_').map(capital).collect();
    format_ident!("{name}")
}

/// An enumeration of names, each with its documentation.
fn enumeration(name: &str, documentation: &str, variants: &[(String, String)]) -> TokenStream {
    let (ident, count) = (format_ident!("{name}"), literal(variants.len()));
    let names = variants.iter().map(|(name, _)| variant(name));
    let (names, documents): (Vec<_>, Vec<_>) = names
        .zip(variants.iter().map(|(_, document)| document))
        .unzip();
    quote! {
        #[doc = #documentation]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum #ident {
            #(#[doc = #documents] #names),*
        }

        impl #ident {
            /// All of them, in order.
            pub const ALL: [Self; #count] = [#(Self::#names),*];
        }
    }
}

/// A method that looks something up in a table with a row for each variant.
fn lookup(name: &str, documentation: &str, ty: &TokenStream, rows: &[TokenStream]) -> TokenStream {
    let (name, count) = (format_ident!("{name}"), literal(rows.len()));
    quote! {
        #[doc = #documentation]
        pub const fn #name(self) -> #ty {
            const ROWS: [#ty; #count] = [#(#rows),*];
            ROWS[self as usize]
        }
    }
}

/// The columns of these places, as a slice.
fn slice(chain: &Chain, places: impl IntoIterator<Item = usize>) -> TokenStream {
    let places = places.into_iter();
    let names = places.map(|place| variant(&chain.columns[place].name));
    quote!(&[#(Column::#names),*])
}

fn columns(chain: &Chain) -> TokenStream {
    let variants = chain.columns.iter().enumerate().map(|(place, column)| {
        let what = if place < chain.inputs {
            ", an input"
        } else {
            ""
        };
        (column.name.clone(), format!(" `{}`{what}.", column.name))
    });
    let variants: Vec<_> = variants.collect();
    let of_columns = " A number that the chain takes or gives.";
    let declared = enumeration("Column", of_columns, &variants);
    let inputs = literal(chain.inputs);
    let each = |row: &dyn Fn(usize) -> TokenStream| -> Vec<TokenStream> {
        (0..chain.columns.len()).map(row).collect()
    };
    let giving = |links: &[Link], kind: &str| {
        let kind = format_ident!("{kind}");
        each(&|place| {
            let giving = links.iter().filter(|link| link.gives_itself(place));
            let names = giving.map(|link| variant(&link.member.name));
            quote!(&[#(#kind::#names),*])
        })
    };
    let name = lookup(
        "name",
        " The name.",
        &quote!(&'static str),
        &each(&|place| {
            let name = &chain.columns[place].name;
            quote!(#name)
        }),
    );
    let masks = each(&|place| {
        let mask = chain.columns[place].inputs;
        quote!(#mask)
    });
    let of_inputs = lookup("inputs", INPUTS, &quote!(u64), &masks);
    let of_stages = " The stages that give it: more than one are alternatives.";
    let stages = giving(&chain.stages, "Stage");
    let stages = lookup("stages", of_stages, &quote!(&'static [Stage]), &stages);
    let of_formulas = " The formulas that give it, each by a way of its own.";
    let formulas = giving(&chain.formulas, "Formula");
    let formulas = lookup(
        "formulas",
        of_formulas,
        &quote!(&'static [Formula]),
        &formulas,
    );
    quote! {
        #declared

        impl Column {
            /// How many of the first are inputs.
            pub const INPUTS: usize = #inputs;

            #name
            #of_inputs
            #stages
            #formulas
        }
    }
}

const INPUTS: &str = " The inputs that it depends on, bit 0 for the first column.";

fn links(kind: &str, documentation: &str, links: &[Link], chain: &Chain) -> TokenStream {
    let variants = links.iter().map(|link| {
        let name = link.member.name.clone();
        let document = format!(" [`{name}`]({name}()).");
        (name, document)
    });
    let variants: Vec<_> = variants.collect();
    let declared = enumeration(kind, documentation, &variants);
    let ident = format_ident!("{kind}");
    let each = |row: &dyn Fn(&Link) -> TokenStream| -> Vec<TokenStream> {
        links.iter().map(row).collect()
    };
    let of_columns = quote!(&'static [Column]);
    let takes = each(&|link| slice(chain, link.takes.iter().copied()));
    let takes = lookup("takes", " What it takes, in order.", &of_columns, &takes);
    let gives = each(&|link| slice(chain, link.gives.iter().copied()));
    let gives = lookup("gives", " What it gives, in order.", &of_columns, &gives);
    let masks = each(&|link| {
        let mask = link.inputs;
        quote!(#mask)
    });
    let masks = lookup("inputs", INPUTS, &quote!(u64), &masks);
    let weights = each(&|link| {
        let module = format_ident!("{}", link.member.name);
        quote!(#module::WEIGHT)
    });
    let of_weights = " What a row costs, in additions; 0 where there is no form over rows.";
    let weights = lookup("weight", of_weights, &quote!(usize), &weights);
    let arms = links.iter().map(arm);
    quote! {
        #declared

        impl #ident {
            #takes
            #gives
            #masks
            #weights

            /// Does something with the body of its rows; none where there is no form over rows.
            pub fn visit<V: ::lanes::chain::Visitor>(self, visitor: V) -> Option<V::Output> {
                match self {
                    #(#arms)*
                }
            }
        }
    }
}

/// How the body of a formula's rows is reached.
fn arm(link: &Link) -> TokenStream {
    let variant = variant(&link.member.name);
    if !link.member.rows {
        return quote!(Self::#variant => None,);
    }
    let module = format_ident!("{}", link.member.name);
    let (along, results) = (literal(link.takes.len()), literal(link.gives.len()));
    let wanted = link.wanted();
    quote!(Self::#variant => Some(visitor.rows::<#module::Rows, #wanted, #along, #results>()),)
}

fn staged(chain: &Chain) -> TokenStream {
    let all = chain.formulas.iter();
    let all = all.flat_map(|link| link.member.staged.iter().map(move |form| (link, form)));
    let all: Vec<(&Link, &StagedMember)> = all.collect();
    let variants = all.iter().map(|(link, form)| {
        let (formula, module) = (&link.member.name, &form.module);
        let document =
            format!(" [`{formula}`]({formula}()), by [`{module}`]({formula}::{module}).");
        (format!("{formula}_{module}"), document)
    });
    let variants: Vec<_> = variants.collect();
    let of_staged = " A formula in stages along some of the columns that it takes.";
    let declared = enumeration("Staged", of_staged, &variants);
    let each = |row: &dyn Fn(&Link, &StagedMember) -> TokenStream| -> Vec<TokenStream> {
        all.iter().map(|(link, form)| row(link, form)).collect()
    };
    let formulas = each(&|link, _| {
        let formula = variant(&link.member.name);
        quote!(Formula::#formula)
    });
    let formulas = lookup("formula", " The formula.", &quote!(Formula), &formulas);
    let of_columns = quote!(&'static [Column]);
    let along = each(&|link, form| slice(chain, link.along(form)));
    let of_along = " The columns that run along the points, in order.";
    let along = lookup("along", of_along, &of_columns, &along);
    let still = each(&|link, form| slice(chain, link.still(form)));
    let of_still = " The columns that stand still, in order.";
    let still = lookup("still", of_still, &of_columns, &still);
    let weights = each(&|link, form| {
        let module = format_ident!("{}", link.member.name);
        let mut forms = link.member.staged.iter();
        let place = forms.position(|known| known.module == form.module);
        let place = literal(place.unwrap_or_default());
        quote!(#module::STAGED_WEIGHTS[#place])
    });
    let of_weights =
        " What it costs for every value of what runs along, and at every point, in additions.";
    let weights = lookup("weights", of_weights, &quote!([usize; 2]), &weights);
    let arms = all.iter().map(|(link, form)| staged_arm(link, form));
    quote! {
        #declared

        impl Staged {
            #formulas
            #along
            #still
            #weights

            /// Does something with the bodies of both loops, and with what is computed once before them.
            pub fn visit<V: ::lanes::chain::StagedVisitor>(self, visitor: V) -> V::Output {
                match self {
                    #(#arms)*
                }
            }
        }
    }
}

/// For each struct that stages give, the way to its numbers and back, in the order of their columns.
fn structures(chain: &Chain) -> Vec<TokenStream> {
    let mut found: Vec<&str> = Vec::new();
    let mut items = Vec::new();
    for link in &chain.stages {
        let Some(structure) = link.member.structure.as_deref() else {
            continue;
        };
        if found.contains(&structure) {
            continue;
        }
        found.push(structure);
        let (ident, count) = (format_ident!("{structure}"), literal(link.gives.len()));
        let fields = link.member.gives.iter();
        let fields: Vec<Ident> = fields
            .map(|given| format_ident!("{}", given.name))
            .collect();
        let trait_doc = format!(" [`{structure}`] as its numbers, in the order of their columns.");
        let (numbers, from) = (
            format_ident!("numbers_of_{}", snake(structure)),
            format_ident!("{}_of_numbers", snake(structure)),
        );
        items.push(quote! {
            #[doc = #trait_doc]
            pub const fn #numbers(of: &#ident) -> [f64; #count] {
                [#(of.#fields),*]
            }

            #[doc = #trait_doc]
            pub const fn #from(numbers: &[f64; #count]) -> #ident {
                let [#(#fields),*] = *numbers;
                #ident { #(#fields),* }
            }
        });
    }
    items
}

/// `SectionLoads` in the name of a function, `section_loads`.
fn snake(name: &str) -> String {
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_ascii_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.push(letter.to_ascii_lowercase());
    }
    snake
}

/// How the bodies of a staged form are reached.
fn staged_arm(link: &Link, form: &StagedMember) -> TokenStream {
    let variant = variant(&format!("{}_{}", link.member.name, form.module));
    let formula = format_ident!("{}", link.member.name);
    let module = format_ident!("{}", form.module);
    let counts = [form.along.len(), link.gives.len(), link.still(form).len()];
    let [along, results, still] = counts.map(literal);
    quote! {
        Self::#variant => {
            use #formula::#module::{Along, FIXED, Points, TABLES, fixed_of};
            visitor.staged::<Along, Points, FIXED, #along, TABLES, #results>(|numbers: &[f64]| {
                let numbers: &[f64; #still] = numbers.try_into().ok()?;
                Some(fixed_of(numbers))
            })
        }
    }
}
