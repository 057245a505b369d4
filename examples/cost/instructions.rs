//! Tables of instructions per call, and whether they show what they should.

use std::io::{self, Write};

use crate::callgrind;
use crate::kernel::{Claim, Row, Table};
use crate::questions;

/// Counts with `calls` arguments of every function.
pub(crate) fn report(out: &mut impl Write, calls: u32) -> io::Result<()> {
    writeln!(out, "## Instructions\n")?;
    let tables = questions::all(calls);
    let Some(counts) = callgrind::instructions(&tables, calls)? else {
        return writeln!(out, "Not counted: there is no `valgrind` on the path.\n");
    };
    writeln!(
        out,
        "Per call, the loads of its arguments, the store of its result and a turn of the loop included; means over {calls}\n\
         arguments, uniform over the hemisphere.\n"
    )?;
    let mut counts = counts.into_iter();
    for table in &tables {
        let counts: Vec<Vec<f64>> =
            table.rows.iter().map(|row| counts.by_ref().take(row.kernels.len()).collect()).collect();
        print(out, table, &counts)?;
    }
    Ok(())
}

fn print(out: &mut impl Write, table: &Table, counts: &[Vec<f64>]) -> io::Result<()> {
    writeln!(out, "| {} | {} |", table.head, table.columns.join(" | "))?;
    writeln!(out, "|---{}|", "|---".repeat(table.columns.len()))?;
    for (row, counts) in table.rows.iter().zip(counts) {
        write!(out, "| {} |", row.name)?;
        for count in counts {
            write!(out, " {count:.0} |")?;
        }
        writeln!(out)?;
    }
    writeln!(out)?;
    let rows = || table.rows.iter().zip(counts);
    match table.claim {
        Claim::Nothing => Ok(()),
        Claim::Rising => {
            // By how many instructions a column is above the one to its right.
            let excess = |counts: &[f64]| {
                counts.windows(2).map(|pair| pair[0] - pair[1]).fold(0.0, |a: f64, b| a.max(b))
            };
            let exceptions: Vec<String> = rows()
                .map(|(row, counts)| (&row.name, excess(counts).round()))
                .filter(|&(_, excess)| excess > 0.0)
                .map(|(name, excess)| format!("{name} by {excess}"))
                .collect();
            let claim = table.columns.join(" ≤ ");
            if exceptions.is_empty() {
                writeln!(out, "{claim} in every row.\n")
            } else {
                writeln!(out, "{claim}, **but not of** {}.\n", exceptions.join("; "))
            }
        }
        Claim::LinearAlike => {
            let linear = |(row, counts): (&Row, &Vec<f64>)| row.name.ends_with("linear").then_some(counts[0]);
            let linear: Vec<f64> = rows().filter_map(linear).collect();
            // By less than an instruction: the numbers of another surface may turn another normal
            // into view.
            let alike = linear.iter().all(|count| (count - linear[0]).abs() < 1.0);
            writeln!(
                out,
                "Every way to a linear map costs the same per call: {}.\n",
                if alike { "yes" } else { "**no**" }
            )
        }
    }
}
