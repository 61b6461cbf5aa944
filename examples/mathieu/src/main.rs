//! Prints the boundaries of Mathieu's equation, and the slope of the lowest one by columns.
#![allow(clippy::print_stdout, reason = "a command speaks through it")]

use std::error::Error;

use mathieu::formulas::slow_exponent;
use mathieu::{Boundary, residuals};

fn main() -> Result<(), Box<dyn Error>> {
    println!(
        "{:>5} {:>14} {:>14} {:>14} {:>14} {:>14}",
        "q", "a0", "b1", "a1", "b2", "a2"
    );
    let rows: Vec<f64> = (0..=10).map(|row| 0.5 * f64::from(row)).collect();
    let mut lowest = Vec::new();
    for &q in &rows {
        print!("{q:5.1}");
        for boundary in Boundary::ALL {
            let a = boundary.at(q).ok_or("Newton's method does not settle")?;
            print!(" {a:14.10}");
            if boundary == Boundary::A0 {
                lowest.push(a);
            }
        }
        println!();
    }
    let (_, slopes) = residuals(&lowest, &rows)?;
    println!("\n{:>5} {:>14}", "q", "da0/dq");
    for (q, slope) in rows.iter().zip(slopes) {
        println!("{q:5.1} {slope:14.10}");
    }
    let (exponent, [by_a, by_q]) = slow_exponent::gradient(40.0, 5.0);
    println!("\nat a = 40, q = 5: exponent {exponent:.10}, by a {by_a:.10}, by q {by_q:.10}");
    Ok(())
}
