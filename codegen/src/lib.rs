//! Generates fast Rust from formulas: values in few operations, exact derivatives, loops over columns.
//!
//! A formula is written once, as a plain Rust function over `f64` that reads like the paper it is from. This crate reads
//! its source, takes its derivatives, looks for the fewest operations that give all that is asked for together, and
//! writes straight-line Rust.
//!
//! To **use** it, put the attribute `rotor_macros::symbolic` on a module of formulas; that crate calls this one. To **look at**
//! what comes of a formula, as Rust, in LaTeX or as a picture of its operations, call [`show`]:
//!
//! ```
//! use codegen::show;
//!
//! let source = r#"
//!     #[symbolic(latex(radius = "r"))]
//!     mod cone {
//!         /// Length of the slanted side.
//!         pub fn side(radius: f64, h: f64) -> f64 {
//!             (radius.powi(2) + h.powi(2)).sqrt()
//!         }
//!
//!         /// Lateral surface.
//!         #[generate(gradient(radius, h))]
//!         pub fn surface(radius: f64, h: f64) -> f64 {
//!             std::f64::consts::PI * radius * side(radius, h)
//!         }
//!     }
//! "#;
//! let mut cone = show::module(source)?;
//! assert_eq!(show::latex(&cone, "side")?.trim(), r"\mathrm{side}(r, h) = \sqrt{r^2 + h^2}");
//!
//! let rust = show::rust(&mut cone, "surface")?;
//! assert!(rust.contains("pub fn gradient(radius: f64, h: f64) -> (f64, [f64; 2])"), "{rust}");
//!
//! // The surface and both its slopes take one root.
//! let forms = show::forms(&mut cone, "surface")?;
//! assert!(forms.iter().all(|form| form.circuit.cost().sqrt == 1));
//! # Ok::<(), show::ShowError>(())
//! ```
//!
//! It is a library on tokens: it does no input or output, and equal sources give equal bytes. What follows is its
//! reference: [the language](#the-language), [formulas in several files](#formulas-in-several-files),
//! [what comes out](#what-comes-out), [its limits](#limits), and the [modules](#modules-in-the-order-in-which-a-formula-passes).
//!
//! # The language
//!
//! A module of functions. A function takes `f64`s, arrays `[f64; N]` and structs, within each other (`[[f64; 3]; 3]`,
//! `[Point; N]`, a struct in a struct), by value or reference, and
//! gives a number, or numbers in a tuple, an array or a struct literal. Its body is statements and an expression of
//!
//! | | |
//! |---|---|
//! | numbers | literals, `2 as f64`, constants of the module, of the function's body and of `std::f64::consts`, all exact: `0.1` is one tenth; a literal below 2.2e-308 is the `f64` that Rust reads; `f64::EPSILON`, `MAX`, `MIN`, `MIN_POSITIVE` |
//! | operators | `+ - * /` |
//! | powers, roots | `powi(n)`, `powf`, `sqrt`, `cbrt`, `hypot`, `recip` |
//! | exponentials | `exp`, `exp2`, `exp_m1`, `ln`, `ln_1p`, `log2`, `log10`, `log` |
//! | angles | `sin`, `cos`, `tan`, `sin_cos` (a tuple), `asin`, `acos`, `atan`, `atan2`, `to_radians`, `to_degrees` |
//! | hyperbolic | `sinh`, `cosh`, `tanh`, `asinh`, `acosh`, `atanh` |
//! | error function | `libm::erf(x)`, `libm::erfc(x)`, of the crate `libm`, on which the crate of the formulas depends then; also by `use libm::erf;` |
//! | corners | `abs`, `min`, `max`, `clamp`, `signum`, `copysign`; `floor`, `ceil`, `round`, `trunc`, `fract` |
//! | both at once | `mul_add` (rounded once) |
//! | choices | `if a < b { … } else if … { … } else { … }`, with `< <= > >= == !=`, `&&`, <code>&#124;&#124;</code> and `!`; `match` on conditions, tuples of them, and by `x if x < 0.0 => …` |
//! | statements | `let`, also of tuples, arrays and structs by patterns, `let mut`; `x = …`, `x += …`, `-= *= /=`, also of `a[i]`, `c.field` and `(a, b) = (b, a)`, and within the branches of `if` and `match` |
//! | loops | `for i in 0..N`, `0..=N`, `for x in [a, b]`, `for (i, x) in q.iter().enumerate()`: over what is known when the formula is read |
//! | whole numbers | `const N: usize = 3;`, variables of loops, `+ - * / %` and comparisons of these: as bounds, indices, exponents of `powi`, and numbers by `i as f64` |
//! | arrays | `[a, b]`, `[0.0; N]`, `q[i]`, `q[i + 1][j]`; `iter`, `rev`, `enumerate`, `zip`, `chain`, `skip`, `take`, `step_by`, `map(\|x\| …)`, `sum`, `product`, `fold(a, \|b, x\| …)`, `len` |
//! | access | `c.field`, `a[0]`, `pair.0` |
//! | structs | `Name { field: x }`, `Name { field: x, ..*c }`; patterns `let Name { field, .. } = c;` |
//! | methods | `impl Name { fn f(&self, x: f64) -> f64 { … } }`, called as `c.f(x)` or `Name::f(&c, x)`, functions without `self`, and constants, `Self::K` |
//! | calls | of other formulas of the module and of those that it links; `f::d_x(…)`, `f::d_x_y(…)` of their partials |
//! | integrals | `integral(\|t\| …, a..b)`, in functions that are tabulated |
//!
//! A function may be called as a method or by its path, `x.atan2(y)` or `f64::atan2(x, y)`. Its value is that of the standard
//! library, which computes it in scalar forms and, number by number, in columns. Of a choice both values are computed and one
//! is selected, in columns too; what is not selected has no part in value or derivative, whatever it is.
//!
//! A loop is followed turn by turn, so that what comes out has none, and a variable that is assigned to stands for its new
//! value from there on; where a branch assigns to it, one of two values is selected. What an `if` or `match` of whole numbers
//! decides is known, and the branch that is not taken is not looked at. A formula has up to 100,000 statements, those of
//! loops and of called formulas counted as often as they are passed. `x += a; x += b;` is `x + a + b`, a sum of three as it
//! is rounded; what is read in between is a number of its own.
//!
//! A method has forms like a function: they are in the module `f`, take the struct first, and are by `self.field` or all of
//! `self`. Blocks of traits and of generic types are left to the compiler, methods are not specialised and take no part in
//! the chain.
//!
//! There are no loops without a range, no `break`, `continue` or early `return`. Whatever else is found is reported at its token with what to write instead, all at once: also functions and constants that need
//! themselves, results of another type than the signature says, fields that a struct of the module does not have, and names
//! that both the author and the generator give.
//!
//! Attributes of a function say what is wanted: `#[generate(value, gradient(x, c.y), jacobian(x, c.y), hessian(x, c.y), columns, stage(c.y),
//! budget(operations = 96))]`, `#[domain(x > 0.0)]`, `#[specialise(name, x = y, generate(…))]`,
//! `#[approximate(x = 0.0..=1.0, factor = x.powi(2), tolerance = 1e-13)]`; see [`parse::attributes`]. The module's own
//! attribute may say how large its numbers are and where they lie, `symbolic(sizes = 1e-9..=1e9, domain(c.beta <= 2.0))`,
//! hold a table of symbols for [`latex`], and link other modules, `symbolic(with(super::stiffness))`.
//!
//! What is derived by, has a domain or is replaced is a number `x`, a field `c.y` or an element `a[0]`; whole parameters may
//! be replaced, too. `gradient(q)` and `hessian(q)` of an array or a struct `q`, or of a part `c.q` or `m[0]` of one, are by
//! all its numbers, each in the place where it is declared: by `m: [[f64; 3]; 3]` the gradient is a `[f64; 9]`, row by row, by
//! `(x, q)` it is one list, `x` first. Columns have one column for each number, `m_0_1` for `m[0][1]`. The length of an array
//! is a number or made of constants of the module and of those that it links; structs within others have to be of these, too.
//! A parameter holds up to 4,096 numbers. The gradient of a result of several numbers has one row for each, as its Jacobian
//! has, which is of such results alone: of `f(q: [f64; 6]) -> [f64; 3]` `f::jacobian(q)` is the value and a `[[f64; 6]; 3]`.
//! The numbers of a tuple, an array or a struct are those of all its parts in order. Without a list, partials are by every number that the function's source names, also through the
//! formulas that it calls, in the order of its parameters; one that cancels stays among them. A budget holds for the richest
//! form asked for, the last of value, gradient and Hessian; partials that other formulas call are not in it. A partial's
//! name must have one meaning: beside parameters `x`, `y` and `x_y` there is no `d_x_y`.
//!
//! # Formulas in several files
//!
//! A module calls formulas of the modules that it links, and uses their constants and structs:
//!
//! ```text
//! // frequency.rs
//! pub use formulas::*;
//!
//! #[symbolic(with(super::conventions))]
//! mod formulas {
//!     #[generate(gradient(omega), d_omega)]
//!     pub fn f_n(omega: f64) -> f64 { … }
//! }
//!
//! // width.rs
//! pub use formulas::*;
//!
//! #[symbolic(with(super::frequency))]
//! mod formulas {
//!     use super::super::frequency::*;
//!
//!     pub fn width(omega: f64) -> f64 { 1.0 / f_n::d_omega(omega) }
//! }
//! ```
//!
//! A path in `with(…)` is that of a module of formulas, or of the module around it that has all its items as its own by
//! `use formulas::*`, which every file of formulas wants to have: an attribute can't stand at a `mod name;` itself. It starts
//! where the attribute stands, outside the module, or at the crate. What a linked module links is known, too.
//!
//! **Names** are those of the compiler, which checks the functions as written: by `use` of a name, of all names or of a
//! module, and by path. Paths in the module start as the one in `with(…)` does: what is linked from `super` is not found from
//! `crate`. Of two names that are imported whole neither is taken. What only the module around says is not seen: import inside.
//!
//! **Settings.** `sizes`, and the domain of each name, are those that the module states; where it does not, those of the modules
//! that it links, which these may have from others. Two that say different things are a mistake at the second's path: state it.
//! A symbol of [`latex`] is that of the first that has one. They hold for what is generated in the module, whatever
//! formulas it calls.
//!
//! **Partials** that another module calls are asked for by name where the formula stands, `#[generate(d_omega)]`; within a
//! module they need not be.
//!
//! **Tables.** Where a linked module has the table of a function that it generates value or gradient of, its table is called; for
//! packs, if the module has columns or stages itself. Otherwise the module makes it anew.
//!
//! **The chain** of all formulas that ask for `chain`, of a module and of those that it links, is in the module whose attribute
//! says `symbolic(chain)`; it imports the structs that the formulas give.
//!
//! A circle of modules is refused, as is a private function by the compiler. A mistake in a linked module is reported
//! there and nowhere else. [`link`] says how it works: by a macro in each module, so that modules are of one crate, stand in
//! modules and not in functions, and some sixty of them may be linked under the compiler's usual `recursion_limit`. A
//! file of formulas has another name than every function that forms are generated of: both are modules to the compiler.
//!
//! # What comes out
//!
//! The module as written, so that the compiler checks it and tests compare with it, and beside the function `f` a module
//! `f` with the generated functions `value`, `gradient`, `jacobian`, `hessian`, `columns`, `gradient_columns`,
//! `jacobian_columns` and partials `d_x`, each
//! documented with its count of operations, partials that other modules call among them. `stage(c.y)` gives a module `along_y`: a function `fixed` of what does not
//! depend on `c.y`, and the bodies `Along` and `Points` of two loops, for tables over the values of `c.y` and for the
//! points. Columns and stages run on the crate `lanes`, which the crate of the formulas depends on. What is made from a
//! function under `#[cfg(…)]` is under it, too.
//!
//!
//! # Two representations
//!
//! A formula is first a [`Graph`](graph::Graph): a hash-consed directed acyclic graph of sums with rational coefficients,
//! products with whole exponents, and functions. In it there is one handle for each value, which makes derivatives and
//! rewriting cheap to state. [`graph`] lists its invariants; the one that matters most to an author: **nothing is ever
//! multiplied out**, the structure of a formula is its author's knowledge about rounding.
//!
//! Then it is a [`Circuit`](circuit::Circuit), in which every operation that will be done is visible and is
//! counted: operands come before their users, sums and products are taken apart as they will be computed, a division is an
//! operation of its own. What is counted is what is emitted.
//!
//! # Limits
//!
//! **The function as written is the reference.** A generated form is taken only if it is finite wherever the author's form is,
//! and its error is no larger than 64 times the author's: operation by operation as Rust evaluates it, partials as dual numbers
//! or the reverse mode derive the author's operations one by one. That is looked at on some 400 points (fewer for formulas of more than 2,600 operations, down to some seventy), of which many have zeros,
//! infinities, what is no number, the smallest and the largest numbers, or numbers of which differences nearly vanish
//! ([`factor::probes`]), by running bounds of the errors and by the errors themselves in twice the digits
//! ([`factor::rounding`]). Where no form with fewer operations passes, the code is the author's own, and its documentation says
//! why: *As it is written: …*.
//!
//! **Say how large numbers are, and forms are free.** By default a formula is right for every `f64`, and 1/(1/x + 1/y) keeps its
//! three divisions, because xy/(x + y) is no number at x = ∞ and leaves the range at 1e170. With
//! `#[symbolic(sizes = 1e-9..=1e9)]` the module's numbers are 0 or of these sizes, and with `#[domain(x > 0.0, x <= 2.0)]` a
//! number lies where it says: forms need be right only there. Engineering formulas in SI units should have both.
//!
//! What a generated form does at the edges of a formula:
//!
//! - **Constants.** Functions of constants are computed when the crate is built, to more digits than a literal has. The
//!   root or logarithm of a negative constant is left in the code and is NaN there, as it is in the function as written.
//! - **Sums against rounding.** `(a + b) - a`, the sum and carry of Kahan and Knuth, a split by `c - (c - x)`, and any sum that is
//!   0 on paper are what rounding makes of them: a formula that has one is generated as it is written. `mul_add` is rounded once
//!   in every form, also in packs, where a machine without the instruction takes long for it.
//! - **Corners.** At a corner, the tie of `min` and `max` and the 0 of `abs`, the derivative is that of the side on which the
//!   first of the variables derived by is a little larger ([`differentiate::corners`]). All corners of a formula are seen from
//!   the same side, so that where they cancel (the softplus, x·|x|, max(x, 0) − max(−x, 0)) the derivative is the true one.
//!   Where one of two is NaN, `min` and `max` and their derivatives are those of the other, as in Rust; where both are, the
//!   derivative may be that of either.
//! - **Choices.** The derivative of an `if` is that of the branch that is taken, also where its condition just holds; an `if`
//!   between the two numbers that it compares is their `min` or `max` with the corner of that, and so is `clamp`. Where rounding
//!   decides a condition, a generated form may take the other branch. `clamp` does not panic: where its bounds are none it gives
//!   the upper one.
//! - **Steps.** The derivative of `signum`, `floor`, `ceil`, `round` and `trunc` is 0, also where they jump, and that of `fract`
//!   is 1; `copysign` has none by the number of which it takes the sign.
//! - **Powers.** The derivative of `x.powf(y)` by `x` is 0 at y = 0 for every `x`, and that by `y` is 0 where the power is 0; for
//!   negative `x` the one by `y` is NaN. At a base of 0 second derivatives by the exponent are those of these cases.
//! - **Lengths.** Derivatives of `hypot` and `atan2` stay in the range of numbers where squares do not; at the origin they are
//!   NaN, where there are none. Second derivatives of `hypot` by one of its numbers lose digits where the other is much smaller.
//! - **Signs of zero and NaN.** A form may be 0 where the author's is −0, and finite where the author's is NaN: x − x and 0·x
//!   are 0, unless a `min`, a `max` or a comparison takes them. The literal `-0.0` is 0; a division by the literal 0 is refused.
//!   What jumps with the sign of a computed zero, `copysign`, `signum`, `atan2` on the negative axis, and the infinity that
//!   a division by one gives, may be on the other side.
//! - **Error function.** `erf` and `erfc` are those of the crate `libm` (the series and rational functions of FreeBSD's msun), the
//!   slope is 2/√π·e^(−x²), which loses as many digits as x² has: at x = 5 it is right to some 9 units in the last place.
//!   Of constants they are computed when the code runs. The gamma function is refused.
//! - **Whole numbers** are known, and go up to 2³¹ − 1 in size, as an `i32`: what leaves that range is refused. A difference
//!   below 0, which is a panic of `usize` in the function as written, is a negative number.
//! - **Size.** Calls may be nested 256 deep, groups of tokens 128 deep; a chain of operators or methods may be of any length.
//!   Searches stop at a stated number of looks ([`budget`]); of more than 2,000 operations one form in one order of extraction is
//!   looked at. Constants and exponents that grow too long while they are gathered
//!   leave the formula as it is written.
//! - **Roots of 0.** A derivative is finite where every part of it is: that of $\sqrt{x^3}$ is, because it is written
//!   $\tfrac32\sqrt x$. That of $\sqrt{x^4 + y^4}$ at the origin is 0 but comes out as $0\cdot\infty$, NaN; so does the one of
//!   $\sqrt{x^2 + y^2}$, which has none there.
//! - **Second derivatives.** Fractions whose difference cancels are joined where a part of a sum, or a rational multiple
//!   of a term of it, is left: those of $\sqrt{x^2 + x + 1}$ keep all digits for all $x$. Where more is left nothing is
//!   multiplied out, and the digits are lost: the second derivative of $\sqrt{x^2 + 1/x}$ is off by $5\cdot10^{-9}$ of itself at
//!   $x = 10^3$, by $3\cdot10^{-5}$ at $10^4$, and by half of itself at $10^6$.
//! - **Range of derivatives.** They have the range of dual numbers on the author's operations: that of 1 − 2/(e^{2x} + 1) at
//!   x = 1000 is 0·∞, NaN; that of (1 − t)/(1 + t) with t = e^{−2x} is 0.
//!
//! # Modules, in the order in which a formula passes
//!
//! | | |
//! |---|---|
//! | [`link`] | the tokens of the modules that a module links, where it links others |
//! | [`parse`] | source to functions, attributes, and values over a graph as written; all checks of what an author writes |
//! | [`graph`] | the graph, as written and in its canonical form, and what is known of signs |
//! | [`gather`] | from the graph as written to the canonical one |
//! | [`differentiate`] | partials in the graph by the reverse and the forward mode |
//! | [`rewrite`] | a table of sound rules, each with its guard |
//! | [`circuit`] | the form in which every operation that will be done is visible, with what it costs |
//! | [`factor`] | the fewest operations over a value and its partials together |
//! | [`stage`] | what is done once, what once for each value of an inner parameter, what at every point |
//! | [`mod@chain`] | which formulas give what others take, from the inputs to every result |
//! | [`emit`] | circuits to tokens: functions of numbers, functions over columns, the loops of stages, the chain |
//! | [`mod@expand`] | the pipeline, and the module that comes out |
//!
//! Beside them: [`budget`] (how long searches go on, counted), [`approximate`] and [`tables`] (integrals and costly functions as piecewise polynomials, fitted when the
//! crate is built), [`interpret`] (evaluates a graph), [`fingerprint`] (tells equal expressions), [`outputs`] (the numbers of one generated function), [`cost`] (counts), [`diagnostics`] (messages at tokens), [`latex`]
//! (source to formulas as printed), [`dot`] (circuits as pictures), [`show`] (all of these by a formula's name).

pub mod approximate;
pub mod budget;
pub mod chain;
pub mod circuit;
pub mod cost;
pub mod diagnostics;
pub mod differentiate;
pub mod dot;
pub mod emit;
pub mod expand;
pub mod factor;
pub mod fingerprint;
pub mod gather;
pub mod graph;
pub mod interpret;
pub mod latex;
pub mod link;
pub mod outputs;
mod parallel;
pub mod parse;
pub mod rewrite;
pub mod show;
pub mod stage;
pub mod symbols;
pub mod tables;

pub use expand::expand;
