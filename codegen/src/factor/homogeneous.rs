//! Euler's relation: a function that is homogeneous in weights w, $f(t^{w_i} x_i) = t\,f(x)$, is $\sum_i w_i x_i\,\partial_i f$.
//!
//! Formulas of engineering are dimensionally homogeneous, so that where all partials are asked for anyway, the value can
//! often be had from a few of them: a determinant from the cofactors of one row.

use std::collections::BTreeSet;

use crate::fingerprint::{Residue, all_at, symbol_at};
use crate::graph::{ExprId, Graph, Node, Rational, ratio};
use crate::outputs::Outputs;

/// The most terms that a relation may have; it would not pay with more.
const MOST_TERMS: usize = 4;

/// The outputs with values rebuilt from their partials, where such a relation is found for any.
pub fn rebuild_values(graph: &mut Graph, outputs: &Outputs) -> Option<Vec<ExprId>> {
    let mut all = outputs.all();
    let mut found = false;
    for (position, gradient) in outputs.gradients.iter().enumerate() {
        let value = *outputs.values.get(position)?;
        let Some(weights) = weights(graph, outputs, value, gradient) else {
            continue;
        };
        let mut terms = Vec::new();
        for (index, weight) in weights {
            let symbol = graph.symbol_expression(*outputs.by.get(index)?);
            terms.push((graph.multiply(symbol, *gradient.get(index)?), weight));
        }
        all[position] = graph.sum(terms);
        found = true;
    }
    found.then_some(all)
}

/// The shortest list of weights, by position among the partials.
fn weights(
    graph: &Graph,
    outputs: &Outputs,
    value: ExprId,
    gradient: &[ExprId],
) -> Option<Vec<(usize, Rational)>> {
    let points = MOST_TERMS + 2;
    let roots: Vec<ExprId> = gradient.iter().copied().chain([value]).collect();
    let mut columns: Vec<Vec<Residue>> = vec![Vec::new(); gradient.len()];
    let mut target = Vec::new();
    for point in 0..points as u64 {
        let at = all_at(graph, &roots, 100 + point);
        for (column, (partial, symbol)) in columns.iter_mut().zip(gradient.iter().zip(&outputs.by))
        {
            column.push(at[partial.index()].times(symbol_at(*symbol, 100 + point)));
        }
        target.push(at[value.index()]);
    }
    let divides = divisions(graph, &[value]);
    let useful: Vec<usize> = (0..columns.len())
        .filter(|i| columns[*i].iter().any(|residue| *residue != Residue::ZERO))
        // A partial that divides where the value does not may be infinite where the value is finite.
        .filter(|i| divisions(graph, &[gradient[*i]]).is_subset(&divides))
        .collect();
    // More candidates would make the search through their subsets long.
    let most = if useful.len() > 16 { 2 } else { MOST_TERMS };
    (1..=most).find_map(|size| {
        subsets(&useful, size).into_iter().find_map(|subset| {
            let chosen: Vec<&Vec<Residue>> = subset.iter().map(|i| &columns[*i]).collect();
            let weights = solve(&chosen, &target)?;
            let fractions = weights
                .iter()
                .map(|weight| weight.as_fraction().filter(|(n, _)| *n != 0));
            let fractions: Option<Vec<(i64, i64)>> = fractions.collect();
            Some(
                subset
                    .iter()
                    .copied()
                    .zip(fractions?.into_iter().map(|(n, d)| ratio(n, d)))
                    .collect(),
            )
        })
    })
}

/// What the roots divide by.
fn divisions(graph: &Graph, roots: &[ExprId]) -> BTreeSet<ExprId> {
    let mut divisors = BTreeSet::new();
    for id in graph.reachable(roots) {
        if let Node::Product(factors) = graph.node(id) {
            divisors.extend(
                factors
                    .iter()
                    .filter(|(_, exponent)| *exponent < 0)
                    .map(|(factor, _)| *factor),
            );
        }
    }
    divisors
}

fn subsets(items: &[usize], size: usize) -> Vec<Vec<usize>> {
    if size == 0 {
        return vec![Vec::new()];
    }
    let Some((first, rest)) = items.split_first() else {
        return Vec::new();
    };
    let mut with: Vec<Vec<usize>> = subsets(rest, size - 1);
    for subset in &mut with {
        subset.insert(0, *first);
    }
    with.extend(subsets(rest, size));
    with
}

/// The solution of Σ wᵢ columnᵢ = target, where there is just one and it satisfies all rows.
fn solve(columns: &[&Vec<Residue>], target: &[Residue]) -> Option<Vec<Residue>> {
    let unknowns = columns.len();
    let mut rows: Vec<Vec<Residue>> = (0..target.len())
        .map(|row| {
            columns
                .iter()
                .map(|column| column[row])
                .chain([target[row]])
                .collect()
        })
        .collect();
    for pivot in 0..unknowns {
        let found = (pivot..rows.len()).find(|row| rows[*row][pivot] != Residue::ZERO)?;
        rows.swap(pivot, found);
        let inverse = rows[pivot][pivot].inverse();
        let scaled: Vec<Residue> = rows[pivot]
            .iter()
            .map(|residue| residue.times(inverse))
            .collect();
        for (row, entries) in rows.iter_mut().enumerate() {
            let factor = entries[pivot].negative();
            if row == pivot || factor == Residue::ZERO {
                continue;
            }
            for (entry, from) in entries.iter_mut().zip(&scaled) {
                *entry = entry.plus(from.times(factor));
            }
        }
        rows[pivot] = scaled;
    }
    let consistent = rows[unknowns..]
        .iter()
        .all(|row| row[unknowns] == Residue::ZERO);
    consistent.then(|| rows[..unknowns].iter().map(|row| row[unknowns]).collect())
}
