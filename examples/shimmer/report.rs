//! Tables: Markdown on the terminal, CSV in a file.

use core::fmt::Write;

use crate::errors::GRAZING;
use crate::study::Study;

/// Explains the columns.
pub(crate) fn print_legend() {
    println!(
        "\
RMSE      root mean square error of linear radiance; toned: of r/(1 + r). Pixels at silhouettes do not count
energy    all radiance over that of the reference
grazing   mean error where the half vector's cosine to the normal is below {GRAZING}, over the reference's mean there
change    mean absolute change of a pixel from frame to frame of the camera's move, over that of the reference
peak      brightest pixel of a frame over that of the reference: lowest and highest of all frames
ns        per pixel, on one thread, of shading with the filter, from derivatives on; only the ratios carry over"
    );
}

/// Prints the table of a scene with one material.
pub(crate) fn print(study: &Study) {
    println!(
        "\n**{} of {}** ({:.1} % of the pixels are grazing; the reference's own RMSE is {:.4})\n",
        study.scene,
        study.material,
        100.0 * study.grazing,
        study.noise
    );
    println!("| # | method | RMSE | toned | energy | grazing | change | peak | ns |");
    println!("|--:|---|--:|--:|--:|--:|--:|--:|--:|");
    for (i, row) in study.rows.iter().enumerate() {
        let [low, high] = row.flicker.peaks();
        let errors = row.errors;
        println!(
            "| {} | {} | {:.4} | {:.4} | {:.3} | {:.3} | {:.2} | {low:.2} to {high:.2} | {} |",
            i + 1,
            row.name,
            errors.rmse,
            errors.toned,
            errors.energy,
            errors.grazing,
            row.flicker.change(),
            row.nanoseconds.map_or_else(|| "–".to_owned(), |ns| format!("{ns:.0}")),
        );
    }
}

/// All tables, a line for each method.
pub(crate) fn csv(studies: &[Study]) -> String {
    let mut csv = "scene,material,method,rmse,toned,energy,grazing,change,peak_low,peak_high,ns\n".to_owned();
    for study in studies {
        for row in &study.rows {
            let ([low, high], e) = (row.flicker.peaks(), row.errors);
            let ns = row.nanoseconds.map_or_else(String::new, |ns| ns.to_string());
            let _ = writeln!(
                csv,
                "{},{},\"{}\",{},{},{},{},{},{low},{high},{ns}",
                study.scene,
                study.material,
                row.name,
                e.rmse,
                e.toned,
                e.energy,
                e.grazing,
                row.flicker.change(),
            );
        }
    }
    csv
}
