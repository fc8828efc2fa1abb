// Light of a disc from the bokeh texture that `petzval lens table` writes; see bokeh_texture.glsl.
struct BokehTable {
    float columns, rows, rows_per_px, largest_radius_px;
};

float bokeh_column(BokehTable table, float radius_px) {
    float t = clamp(radius_px / table.largest_radius_px, -1.0, 1.0);
    return (sign(t) * sqrt(abs(t)) + 1.0) * 0.5 * (table.columns - 1.0);
}

float2 bokeh_place(BokehTable table, float radius_px, float distance_px) {
    return float2((bokeh_column(table, radius_px) + 0.5) / table.columns,
                  (distance_px * table.rows_per_px + 0.5) / table.rows);
}
