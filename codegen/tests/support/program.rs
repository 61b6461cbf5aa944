//! Modules of formulas as trees, which can be printed as Rust and cut down.

/// The numbers that the formula takes, in the order of its parameters.
pub const INPUTS: [&str; 6] = ["x", "y", "a[0]", "a[1]", "s.p", "s.q"];

/// What stands at one place of an expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    Name(String),
    Literal(String),
    Negative,
    /// The terms that are subtracted; the first never is.
    Sum(Vec<bool>),
    Product,
    Quotient,
    /// A method on the first part, with the others as its arguments.
    Method(&'static str),
    Power(i32),
    /// A method as a function, `f64::atan2(a, b)`.
    Function(&'static str),
    /// The last part but one where its condition holds, else the last; a condition compares two parts, and may be joined with
    /// another that does.
    If(&'static str, Option<(&'static str, &'static str)>),
    /// A helper on two numbers, or its partial of that name.
    Call(usize, Option<String>),
    /// A block that binds its first part and gives its second.
    Block(String),
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    pub kind: Kind,
    pub parts: Vec<Node>,
}

impl Node {
    pub fn new(kind: Kind, parts: Vec<Node>) -> Self {
        Self { kind, parts }
    }

    pub fn name(name: &str) -> Self {
        Self::new(Kind::Name(name.to_owned()), Vec::new())
    }

    pub fn literal(digits: &str) -> Self {
        Self::new(Kind::Literal(digits.to_owned()), Vec::new())
    }

    pub fn count(&self) -> usize {
        1 + self.parts.iter().map(Self::count).sum::<usize>()
    }

    /// Calls `visit` with every node.
    pub fn each(&self, visit: &mut impl FnMut(&Node)) {
        visit(self);
        self.parts.iter().for_each(|part| part.each(visit));
    }

    /// The node at that position, counted from the root down.
    fn at(&mut self, position: &mut usize) -> Option<&mut Node> {
        if *position == 0 {
            return Some(self);
        }
        *position -= 1;
        self.parts.iter_mut().find_map(|part| part.at(position))
    }

    fn rust(&self, helpers: &[Helper]) -> String {
        let part = |position: usize| self.parts[position].rust(helpers);
        // An operand in parentheses, unless it needs none.
        let tight = |position: usize| match self.parts[position].kind {
            Kind::Name(_) | Kind::Literal(_) => part(position),
            Kind::Method(_) | Kind::Power(_) | Kind::Call(..) | Kind::Function(_) => part(position),
            _ => format!("({})", part(position)),
        };
        match &self.kind {
            Kind::Name(text) | Kind::Literal(text) => text.clone(),
            Kind::Negative => format!("-{}", tight(0)),
            Kind::Sum(minus) => {
                let mut text = tight(0);
                for (position, minus) in minus.iter().enumerate().skip(1) {
                    text += if *minus { " - " } else { " + " };
                    text += &tight(position);
                }
                text
            }
            Kind::Product => format!("{} * {}", tight(0), tight(1)),
            Kind::Quotient => format!("{} / {}", tight(0), tight(1)),
            Kind::Method(name) => {
                let arguments: Vec<String> = (1..self.parts.len()).map(part).collect();
                format!("{}.{name}({})", tight(0), arguments.join(", "))
            }
            Kind::Function(name) => {
                let arguments: Vec<String> = (0..self.parts.len()).map(part).collect();
                format!("f64::{name}({})", arguments.join(", "))
            }
            Kind::If(comparison, joined) => {
                let compared = |first: usize, comparison: &str| {
                    format!("{} {comparison} {}", tight(first), tight(first + 1))
                };
                let mut condition = compared(0, comparison);
                let mut taken = 2;
                if let Some((join, comparison)) = joined {
                    condition += &format!(" {join} {}", compared(2, comparison));
                    taken = 4;
                }
                format!(
                    "if {condition} {{ {} }} else {{ {} }}",
                    part(taken),
                    part(taken + 1)
                )
            }
            Kind::Power(exponent) => format!("{}.powi({exponent})", tight(0)),
            Kind::Call(helper, partial) => {
                let partial = partial.as_ref().map(|name| format!("::{name}"));
                let arguments = helpers[*helper].shape.arguments(&part(0), &part(1));
                format!("h{helper}{}({arguments})", partial.unwrap_or_default())
            }
            Kind::Block(name) => format!("{{ let {name} = {}; {} }}", part(0), part(1)),
        }
    }
}

/// How a helper takes its two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    Numbers,
    Array,
    Struct,
}

impl Shape {
    pub fn names(self) -> [&'static str; 2] {
        match self {
            Self::Numbers => ["u", "v"],
            Self::Array => ["w[0]", "w[1]"],
            Self::Struct => ["c.p", "c.q"],
        }
    }

    /// The ends of the names of its partials.
    pub fn partials(self) -> [&'static str; 2] {
        match self {
            Self::Numbers => ["u", "v"],
            Self::Array => ["w_0", "w_1"],
            Self::Struct => ["c_p", "c_q"],
        }
    }

    fn parameters(self) -> &'static str {
        match self {
            Self::Numbers => "u: f64, v: f64",
            Self::Array => "w: [f64; 2]",
            Self::Struct => "c: &S",
        }
    }

    fn arguments(self, first: &str, second: &str) -> String {
        match self {
            Self::Numbers => format!("{first}, {second}"),
            Self::Array => format!("[{first}, {second}]"),
            Self::Struct => format!("&S {{ p: {first}, q: {second} }}"),
        }
    }
}

/// How a `let` binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binding {
    Number,
    Tuple,
    Array,
    Struct,
    /// A struct with one field of its own and the rest of the parameter `s`.
    Rest,
}

/// A `let`.
#[derive(Clone, Debug, PartialEq)]
pub struct Let {
    pub name: String,
    pub binding: Binding,
    pub nodes: Vec<Node>,
}

impl Let {
    /// The names that it makes.
    pub fn names(&self) -> Vec<String> {
        let name = &self.name;
        match self.binding {
            Binding::Number => vec![name.clone()],
            Binding::Tuple => vec![format!("{name}a"), format!("{name}b")],
            Binding::Array => vec![format!("{name}[0]"), format!("{name}[1]")],
            Binding::Struct | Binding::Rest => vec![format!("{name}.p"), format!("{name}.q")],
        }
    }

    fn rust(&self, helpers: &[Helper]) -> String {
        let name = &self.name;
        let nodes: Vec<String> = self.nodes.iter().map(|node| node.rust(helpers)).collect();
        match (self.binding, nodes.as_slice()) {
            (Binding::Tuple, [a, b]) => format!("let ({name}a, {name}b): (f64, f64) = ({a}, {b});"),
            (Binding::Array, [a, b]) => format!("let {name} = [{a}, {b}];"),
            (Binding::Struct, [a, b]) => format!("let {name} = S {{ p: {a}, q: {b} }};"),
            (Binding::Rest, [a]) => format!("let {name} = S {{ p: {a}, ..*s }};"),
            _ => format!("let {name} = {};", nodes[0]),
        }
    }
}

/// A function that others call.
#[derive(Clone, Debug, PartialEq)]
pub struct Helper {
    pub shape: Shape,
    pub lets: Vec<Let>,
    pub result: Node,
}

/// The shape of the formula's result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    Number,
    Tuple,
    Array,
    Struct,
}

/// A module with the function `formula` and what it calls.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    pub helpers: Vec<Helper>,
    pub lets: Vec<Let>,
    pub results: Vec<Node>,
    pub output: Output,
    /// Inputs by position, and how each is compared with 0.
    pub domain: Vec<(usize, &'static str)>,
}

impl Program {
    /// Every expression of it.
    pub fn roots(&self) -> Vec<&Node> {
        let mut roots: Vec<&Node> = Vec::new();
        for helper in &self.helpers {
            roots.extend(helper.lets.iter().flat_map(|bound| &bound.nodes));
            roots.push(&helper.result);
        }
        roots.extend(self.lets.iter().flat_map(|bound| &bound.nodes));
        roots.extend(&self.results);
        roots
    }

    fn roots_mut(&mut self) -> Vec<(bool, &mut Node)> {
        let mut roots: Vec<(bool, &mut Node)> = Vec::new();
        for helper in &mut self.helpers {
            let lets = helper.lets.iter_mut().flat_map(|bound| &mut bound.nodes);
            roots.extend(lets.map(|node| (true, node)));
            roots.push((true, &mut helper.result));
        }
        let lets = self.lets.iter_mut().flat_map(|bound| &mut bound.nodes);
        roots.extend(lets.map(|node| (false, node)));
        roots.extend(self.results.iter_mut().map(|node| (false, node)));
        roots
    }

    pub fn count(&self) -> usize {
        self.roots().into_iter().map(Node::count).sum()
    }

    /// The node at that position of all, and whether it is in a helper.
    pub fn node_at(&mut self, mut position: usize) -> Option<(bool, &mut Node)> {
        for (in_helper, root) in self.roots_mut() {
            let count = root.count();
            if position < count {
                return root.at(&mut position).map(|node| (in_helper, node));
            }
            position -= count;
        }
        None
    }

    /// Whether a name, or a part of what has it, is used.
    pub fn uses(&self, name: &str) -> bool {
        let mut used = false;
        let is_of = |text: &str| {
            text.strip_prefix(name)
                .is_some_and(|rest| ["", "a", "b"].contains(&rest) || rest.starts_with(['.', '[']))
        };
        for root in self.roots() {
            root.each(&mut |node| {
                used |= matches!(&node.kind, Kind::Name(text) if is_of(text));
            });
        }
        used
    }

    /// The values of all literals.
    pub fn literals(&self) -> Vec<f64> {
        let mut literals = Vec::new();
        for root in self.roots() {
            root.each(&mut |node| {
                if let Kind::Literal(digits) = &node.kind {
                    literals.extend(digits.trim_end_matches("f64").parse::<f64>().ok());
                }
            });
        }
        literals
    }

    /// As Rust.
    pub fn source(&self) -> String {
        let mut text = String::from(
            "mod hostile {\n    use std::f64::consts::{E, FRAC_PI_2, LN_2, PI, SQRT_2};\n    const K: f64 = 0.1 * 3.0;\n    pub struct S { pub p: f64, pub q: f64 }\n",
        );
        for (position, helper) in self.helpers.iter().enumerate() {
            let parameters = helper.shape.parameters();
            let lets: Vec<String> = helper.lets.iter().map(|b| b.rust(&self.helpers)).collect();
            let result = helper.result.rust(&self.helpers);
            text += &format!(
                "    fn h{position}({parameters}) -> f64 {{ {} {result} }}\n",
                lets.join(" ")
            );
        }
        for (input, comparison) in &self.domain {
            text += &format!("    #[domain({} {comparison} 0.0)]\n", INPUTS[*input]);
        }
        let results: Vec<String> = self.results.iter().map(|r| r.rust(&self.helpers)).collect();
        let results = results.join(", ");
        let (ty, result) = match self.output {
            Output::Number => ("f64", results),
            Output::Tuple => ("(f64, f64)", format!("({results})")),
            Output::Array => ("[f64; 2]", format!("[{results}]")),
            Output::Struct => ("S", format!("S {{ {} }}", self.fields())),
        };
        text += &format!(
            "    #[generate(value, gradient, hessian, columns)]\n    pub fn formula(x: f64, y: f64, a: [f64; 2], s: &S) -> {ty} {{\n"
        );
        for bound in &self.lets {
            text += &format!("        {}\n", bound.rust(&self.helpers));
        }
        text + &format!("        {result}\n    }}\n}}\n")
    }

    fn fields(&self) -> String {
        let [p, q] = self.results.as_slice() else {
            panic!("a struct of two")
        };
        format!("p: {}, q: {}", p.rust(&self.helpers), q.rust(&self.helpers))
    }
}
