use crate::show;
use crate::symbols::balanced;

const TABLE: &str = r#"latex(speed = "\\Omega", delta_k = "\\Delta k", f_start = "\\Omega_s")"#;

/// The LaTeX of `pub fn f` in a module with a table and some neighbours.
fn latex(function: &str) -> String {
    let source = format!(
        "#[symbolic({TABLE})] mod m {{
            pub const edge: f64 = 32.0; pub struct Pair {{ pub beta: f64, pub k_tt: f64 }}
            pub fn f_n(omega: f64, speed: f64, c: &Pair) -> f64 {{ omega - c.beta * speed }}
            pub fn f_start(c: &Pair) -> f64 {{ c.beta }}
            {function}
        }}"
    );
    let text = show::latex(&show::module(&source).unwrap(), "f").unwrap();
    assert!(balanced(&text), "{text}");
    text.trim_end().to_owned()
}

/// The right side of a formula of `x`, `y`, `c`.
fn body(expression: &str) -> String {
    let text = latex(&format!(
        "pub fn f(x: f64, y: f64, c: &Pair) -> f64 {{ {expression} }}"
    ));
    text.strip_prefix("f(x, y) = ").unwrap_or(&text).to_owned()
}

#[test]
fn parentheses_stand_where_they_are_needed() {
    let cases = [
        ("x + (y + 1.0)", "x + y + 1"),
        ("x - (y + 1.0)", "x - (y + 1)"),
        ("x - (y - 1.0) * 2.0", r"x - (y - 1) \cdot 2"),
        ("(x + y) * (x - y)", "(x + y) (x - y)"),
        ("(x * y).powi(2)", "(x y)^2"),
        ("x * y.powi(12)", "x y^{12}"),
        ("(x / y).powi(-1)", r"\left(\frac{x}{y}\right)^{-1}"),
        ("x.powi(2).powi(3)", "(x^2)^3"),
        ("-x * y", "-x y"),
        ("(-x).powi(2)", "(-x)^2"),
        ("x * -y", "-x y"),
        ("x + -y", "x - y"),
        ("x - -y", "x + y"),
        ("-(x + y)", "-(x + y)"),
        ("(x + y) / -y", r"-\frac{x + y}{y}"),
        ("edge * x * y", r"\mathrm{edge}\, x y"),
        ("x * edge / y", r"\frac{x\, \mathrm{edge}}{y}"),
        ("x * y / c.beta * 2.0", r"\frac{x y}{\beta} \cdot 2"),
    ];
    for (source, expected) in cases {
        assert_eq!(body(source), expected, "{source}");
    }
}

#[test]
fn functions_and_constants() {
    let cases = [
        ("(1.0 - x).sqrt()", r"\sqrt{1 - x}"),
        ("(2.0 * x).cos()", r"\cos(2 x)"),
        ("x.sin().powi(2)", r"\sin^2(x)"),
        ("(x / y).abs()", r"\left|\frac{x}{y}\right|"),
        ("x.max(0.0)", r"\max(x, 0)"),
        ("(-x).exp()", "e^{-x}"),
        ("x.recip()", r"\frac{1}{x}"),
        ("x.mul_add(y, -1.0)", "x y - 1"),
        ("std::f64::consts::FRAC_PI_2 * x", r"\frac{\pi}{2} x"),
        ("2.5e3 * x", r"2.5 \cdot 10^3 x"),
        (
            "integral(|t| (t * x).cos() + t, 0.0..y)",
            r"\int_{0}^{y} (\cos(t x) + t) \,\mathrm{d}t",
        ),
    ];
    for (source, expected) in cases {
        assert_eq!(body(source), expected, "{source}");
    }
}

#[test]
fn names() {
    let cases = [
        ("omega", r"\omega"),
        ("omega_bar", r"\bar{\omega}"),
        ("omega_bar_2", r"\bar{\omega}_2"),
        ("epsilon_12", r"\epsilon_{12}"),
        ("f11", "f_{11}"),
        ("k_tt", "k_{tt}"),
        ("moment_t_1", r"\mathrm{moment}_{t 1}"),
        ("edge_factor", r"\mathrm{edge~factor}"),
        ("by_bending", r"\mathrm{by~bending}"),
        ("speed", r"\Omega"),
        ("psi_x", r"\psi_x"),
    ];
    for (name, expected) in cases {
        assert_eq!(
            show::module(&format!("#[symbolic({TABLE})] mod m {{}}"))
                .unwrap()
                .latex_symbols()
                .latex(name),
            expected
        );
    }
    assert_eq!(
        latex("pub fn f(delta_k: f64) -> f64 { delta_k.powi(2) }"),
        r"f(\Delta k) = (\Delta k)^2"
    );
}

#[test]
fn calls_and_partials() {
    let cases = [
        ("f_start(c) * x", r"\Omega_s x"),
        ("f_n(x + 1.0, y, c)", "f_n(x + 1, y)"),
        (
            "f_n::d_omega(x, y, c)",
            r"\frac{\partial f_n}{\partial \omega}(x, y)",
        ),
        (
            "f_n::d_omega_speed(x, y, c)",
            r"\frac{\partial^2 f_n}{\partial \omega\, \partial \Omega}(x, y)",
        ),
        (
            "f_n::d_c_beta(x, y, c)",
            r"\frac{\partial f_n}{\partial \beta}(x, y)",
        ),
        (
            "f_n::d_omega_omega(x, y, c)",
            r"\frac{\partial^2 f_n}{\partial \omega^2}(x, y)",
        ),
    ];
    for (source, expected) in cases {
        assert_eq!(body(source), expected, "{source}");
    }
}

#[test]
fn lines() {
    let source = "pub fn f(x: f64, c: &Pair) -> Pair { let h = x * c.beta; let h = h + 1.0; Pair { beta: h, k_tt: x } }";
    assert_eq!(
        latex(source),
        "\\begin{aligned}\n\\beta &= h'\\\\\nk_{tt} &= x\\\\\nh &= x \\beta\\\\\nh' &= h + 1\n\\end{aligned}"
    );
    let pair = latex("pub fn f(x: f64) -> (f64, f64) { (x, -x) }");
    assert_eq!(
        pair,
        "\\begin{aligned}\nf_1(x) &= x\\\\\nf_2(x) &= -x\n\\end{aligned}"
    );
    let long = format!(
        "pub fn f(x: f64) -> f64 {{ {} }}",
        ["12345678.5 * x"; 12].join(" - ")
    );
    assert!(latex(&long).contains("x\\\\\n&\\quad - 12345678.5 x"));
}

#[test]
fn a_formula_in_full_defines_what_it_calls() {
    let source = format!(
        "#[symbolic({TABLE})] mod m {{
            pub struct Pair {{ pub beta: f64 }}
            pub fn g(x: f64) -> f64 {{ h(x) - x }}
            pub fn h(x: f64) -> f64 {{ x.powi(3) }}
            pub fn f(x: f64, c: &Pair) -> f64 {{ let beta_2 = c.beta.powi(2); h(x) + g(x) * beta_2.powi(2) + g(2.0) }}
            pub fn pair(p: &Pair) -> Pair {{ Pair {{ beta: p.beta }} }}
        }}"
    );
    let module = show::module(&source).unwrap();
    assert_eq!(
        show::latex_in_full(&module, "f").unwrap(),
        "\\begin{aligned}\nf(x) &= h(x) + g(x) (\\beta^2)^2 + g(2)\\\\\n&\\text{where}\\\\\nh(x) &= x^3\\\\\n\
         g(x) &= h(x) - x\n\\end{aligned}\n"
    );
    assert_eq!(show::latex_in_full(&module, "h").unwrap(), "h(x) = x^3\n");
}

#[test]
fn two_structs_of_one_type_are_told_apart() {
    let source = "pub fn f(a: &Pair, b: &Pair) -> f64 { a.beta - b.beta * b.k_tt }";
    assert_eq!(latex(source), r"f(a, b) = a.\beta - b.\beta k_{tt}");
}

#[test]
fn functions_have_their_notation() {
    let cases = [
        ("f64::atan2(x, y)", r"\operatorname{atan2}(x, y)"),
        (
            "x.asin() + x.acosh()",
            r"\arcsin(x) + \operatorname{arcosh}(x)",
        ),
        ("x.tanh().powi(2)", r"\tanh^2(x)"),
        ("x.hypot(y + 1.0)", r"\sqrt{x^2 + (y + 1)^2}"),
        ("2.0 * x.exp_m1()", r"2 (e^x - 1)"),
        ("x.ln_1p() * x.cbrt()", r"\ln(1 + x) \sqrt[3]{x}"),
        ("x.powf(y / 2.0)", r"x^{\frac{y}{2}}"),
        (
            "x.log10() + x.log2() + x.log(y)",
            r"\log_{10}(x) + \log_2(x) + \log_{y}(x)",
        ),
        (
            "x.floor() - x.ceil()",
            r"\lfloor x \rfloor - \lceil x \rceil",
        ),
        ("x.clamp(-1.0, y)", r"\operatorname{clamp}(x, -1, y)"),
        ("2 as f64 * f64::EPSILON", r"2 \cdot 2^{-52}"),
    ];
    for (formula, expected) in cases {
        let source = format!("pub fn f(x: f64, y: f64) -> f64 {{ {formula} }}");
        assert_eq!(latex(&source), format!("f(x, y) = {expected}"));
    }
}

#[test]
fn choices_are_cases() {
    let source = "pub fn f(x: f64, y: f64) -> f64 { const K: f64 = 2.0; let t = if x < y && !(y >= K || x == 1.0) { x } else if x != y { K * y } else { 0.0 }; t * match x > y { true => x, false => y } }";
    assert_eq!(
        latex(source),
        "\\begin{aligned}\nf(x, y) &= t \\begin{cases} x & \\text{if } x > y \\\\ y & \\text{otherwise} \\end{cases}\\\\\nK &= 2\\\\\nt &= \\begin{cases} x & \\text{if } x < y \\land \\lnot (y \\ge K \\lor x = 1) \\\\ K y & \\text{if } x \\ne y \\\\ 0 & \\text{otherwise} \\end{cases}\n\\end{aligned}"
    );
}

#[test]
fn mistakes_are_told() {
    let shown =
        show::module("#[symbolic] mod m { pub fn f(x: f64) -> f64 { loop { break x } } }").unwrap();
    let error = show::latex(&shown, "f").unwrap_err();
    assert!(error.to_string().contains("is not typeset"), "{error}");
    let source = "#[symbolic] mod m { pub fn f(x: f64) -> f64 { let mut y = x; for _ in 0..3 { y += x; } y } }";
    let shown = show::module(source).unwrap();
    let error = show::latex(&shown, "f").unwrap_err();
    assert!(
        error.to_string().contains("a loop is not typeset"),
        "{error}"
    );
    let error = show::latex(&shown, "g").unwrap_err();
    assert!(error.to_string().contains("did you mean `f`?"), "{error}");
}

#[test]
fn tables_are_checked() {
    let cases = [
        (r#"latex(a = "x", a = "y")"#, "has a symbol already"),
        (r#"latex(a = "{x")"#, "braces of the symbol do not match"),
        (r#"latex(a = 2)"#, "not a name and its symbol"),
        (r#"tex(a = "x")"#, "and nothing else"),
        ("sizes = 2.0..=1e9", "not a range of sizes"),
        ("latex = 2 3", "expected"),
    ];
    for (attribute, expected) in cases {
        let text = crate::expand(
            attribute.parse().unwrap(),
            quote::quote!(
                mod m {}
            ),
        )
        .to_string();
        assert!(
            text.contains("compile_error") && text.contains(expected),
            "{text}"
        );
    }
}

#[test]
fn functions_of_crates_stand_by_their_names() {
    let source = "pub fn f(x: f64) -> f64 { 0.5 * libm::erfc(-x) }";
    assert_eq!(latex(source), r"f(x) = 0.5 \operatorname{erfc}(-x)");
}
