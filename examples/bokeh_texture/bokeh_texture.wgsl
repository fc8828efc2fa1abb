// Light of a disc from the bokeh texture that `petzval lens table` writes; see bokeh_texture.glsl.
struct BokehTable {
    columns: f32, rows: f32, rows_per_px: f32, largest_radius_px: f32,
}

fn bokeh_column(table: BokehTable, radius_px: f32) -> f32 {
    let t = clamp(radius_px / table.largest_radius_px, -1.0, 1.0);
    return (sign(t) * sqrt(abs(t)) + 1.0) * 0.5 * (table.columns - 1.0);
}

fn bokeh_place(table: BokehTable, radius_px: f32, distance_px: f32) -> vec2<f32> {
    return vec2<f32>((bokeh_column(table, radius_px) + 0.5) / table.columns,
                     (distance_px * table.rows_per_px + 0.5) / table.rows);
}
