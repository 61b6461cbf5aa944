//! What parameters, their fields and their elements hold, as their types say.

use std::sync::Arc;

use syn::Type;

use super::module::Module;
use super::whole;
use crate::diagnostics::alike;

/// The most numbers that one parameter holds: each is a symbol of its own.
pub(crate) const MOST_NUMBERS: usize = 4096;

/// How deep structs and arrays may stand in each other; a struct that holds itself, which the compiler refuses, ends there.
const DEEPEST: usize = 16;

/// What a value of a type holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One `f64`.
    Number,
    /// `[T; n]`
    Array(Box<Shape>, usize),
    /// A struct by its name; the fields of one from elsewhere are not known, and are taken for numbers.
    Struct(String, Option<Fields>),
}

/// The fields of a struct by their names.
pub type Fields = Arc<Vec<(String, Shape)>>;

impl Shape {
    /// The shape of a parameter's type. `None` if no parameter is of such a type.
    pub(crate) fn of(module: &Module, ty: &Type) -> Option<Self> {
        match ty {
            // Numbers come by value: the generated code computes with them as they are.
            Type::Reference(reference) if reference.mutability.is_none() => {
                Self::of(module, &reference.elem).filter(|shape| *shape != Self::Number)
            }
            Type::Paren(paren) => Self::of(module, &paren.elem),
            Type::Array(array) => {
                let length = whole::constant(module, &array.len)?;
                let element = Self::of(module, &array.elem)?;
                Some(Self::Array(
                    Box::new(element),
                    usize::try_from(length).ok()?,
                ))
            }
            Type::Path(path) if path.path.is_ident("f64") => Some(Self::Number),
            Type::Path(path) => {
                let last = path.path.segments.last()?;
                let plain = !is_other_type(&path.path) && last.arguments.is_none();
                plain.then(|| {
                    Self::Struct(
                        last.ident.to_string(),
                        fields_at(module, &path.path, DEEPEST),
                    )
                })
            }
            _ => None,
        }
        .filter(|shape| shape.count().is_none_or(|count| count <= MOST_NUMBERS))
    }

    /// The shape of a field's type: of what is neither an array nor a struct that is known, a number.
    fn of_field(module: &Module, ty: &Type, depth: usize) -> Self {
        match ty {
            Type::Paren(paren) => Self::of_field(module, &paren.elem, depth),
            Type::Group(group) => Self::of_field(module, &group.elem, depth),
            Type::Array(array) => {
                let length = whole::constant(module, &array.len);
                match length.and_then(|length| usize::try_from(length).ok()) {
                    Some(length) => {
                        let element = Self::of_field(module, &array.elem, depth);
                        Self::Array(Box::new(element), length)
                    }
                    None => Self::Number,
                }
            }
            Type::Path(path) => {
                let last = path.path.segments.last();
                match (last, fields_at(module, &path.path, depth)) {
                    (Some(last), fields @ Some(_)) => Self::Struct(last.ident.to_string(), fields),
                    _ => Self::Number,
                }
            }
            _ => Self::Number,
        }
    }

    /// How many numbers it holds; `None` where a struct is not known.
    pub(crate) fn count(&self) -> Option<usize> {
        match self {
            Self::Number => Some(1),
            Self::Array(element, length) => Some(element.count()?.saturating_mul(*length)),
            Self::Struct(_, fields) => fields
                .as_ref()?
                .iter()
                .try_fold(0_usize, |count, (_, field)| {
                    Some(count.saturating_add(field.count()?))
                }),
        }
    }

    /// The names of all its numbers below that of the whole, in the order of the declaration; of a struct that is not known
    /// there are none.
    pub(crate) fn numbers(&self, name: &str) -> Vec<String> {
        match self {
            Self::Number => vec![name.to_owned()],
            Self::Array(element, length) => {
                let places = 0..*length;
                places
                    .flat_map(|place| element.numbers(&format!("{name}[{place}]")))
                    .collect()
            }
            Self::Struct(_, fields) => {
                let fields = fields.iter().flat_map(|fields| fields.iter());
                fields
                    .flat_map(|(field, shape)| shape.numbers(&format!("{name}.{field}")))
                    .collect()
            }
        }
    }

    /// The part at the end of a path such as `.field[0]`, or what to write instead; `name` is that of the whole.
    pub(crate) fn part(&self, name: &str, path: &str) -> Result<&Self, String> {
        if path.is_empty() {
            return Ok(self);
        }
        match self {
            Self::Number => Err(format!("write `{name}`: it is a number")),
            Self::Array(element, length) => {
                let index = path.strip_prefix('[').and_then(|path| path.split_once(']'));
                let known = index
                    .filter(|(place, _)| place.parse::<usize>().is_ok_and(|place| place < *length));
                match (known, length.checked_sub(1)) {
                    (Some((place, rest)), _) => element.part(&format!("{name}[{place}]"), rest),
                    (None, Some(last)) => {
                        Err(format!("its elements are `{name}[0]` to `{name}[{last}]`"))
                    }
                    (None, None) => Err(format!("`{name}` is empty")),
                }
            }
            Self::Struct(_, fields) => {
                let path = path.strip_prefix('.');
                let end = |path: &str| path.find(['.', '[']).unwrap_or(path.len());
                let field = path.map(|path| path.split_at(end(path)));
                match (fields, field) {
                    (Some(fields), Some((field, rest))) => {
                        let known = fields.iter().find(|(known, _)| known == field);
                        match known {
                            Some((_, shape)) => shape.part(&format!("{name}.{field}"), rest),
                            None => Err(nearest_field(name, Some(field), fields)),
                        }
                    }
                    (Some(fields), None) => Err(nearest_field(name, None, fields)),
                    (None, Some((_, ""))) => Ok(&Self::Number),
                    (None, _) => Err(format!("name a field of it: `{name}.field`")),
                }
            }
        }
    }
}

/// What to write for a field that there is not.
fn nearest_field(name: &str, field: Option<&str>, fields: &[(String, Shape)]) -> String {
    let known = fields.iter().map(|(known, _)| known.as_str());
    match field.and_then(|field| alike(field, known)) {
        Some(known) => format!("did you mean `{name}.{known}`?"),
        None => {
            let fields = fields.iter().map(|(field, _)| format!("`{name}.{field}`"));
            format!("its numbers are {}", fields.collect::<Vec<_>>().join(", "))
        }
    }
}

/// The fields of a struct that is known, by its path.
fn fields_at(module: &Module, path: &syn::Path, depth: usize) -> Option<Fields> {
    let (home, fields) = module.fields_at(path)?;
    let depth = depth.checked_sub(1)?;
    let of = |(name, ty): &(String, Type)| (name.clone(), Shape::of_field(home, ty, depth));
    Some(Arc::new(fields.iter().map(of).collect()))
}

/// Whether the path is a type of the language that no formula computes with.
pub(super) fn is_other_type(path: &syn::Path) -> bool {
    const OTHER: [&str; 16] = [
        "f32", "i8", "i16", "i32", "i64", "i128", "isize", "u8", "u16", "u32", "u64", "u128",
        "usize", "bool", "char", "String",
    ];
    path.segments
        .last()
        .is_some_and(|last| OTHER.iter().any(|name| last.ident == name))
}
