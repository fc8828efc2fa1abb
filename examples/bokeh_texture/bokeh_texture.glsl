// Light of a disc from the bokeh texture that `petzval lens table` writes. The table is a picture of
// `columns` x `rows`: column by signed radius of the circle of confusion, row by distance from the disc's
// middle. Read it with linear filtering and clamped edges.
//
// The numbers are attributes of the file: petzval:columns, petzval:rowsPerPixel, petzval:largestRadius. A
// disc that is `scale` times larger than on the picture of the table (more pixels, or another focal length
// with the same f-number on a sensor scaled alike) has the same column: divide radius and distance by
// `scale`, and the light by scale^2.
struct BokehTable {
    float columns, rows, rows_per_px, largest_radius_px;
};

// Column for a radius: radii grow with the square of the distance from the middle column.
float bokeh_column(BokehTable table, float radius_px) {
    float t = clamp(radius_px / table.largest_radius_px, -1.0, 1.0);
    return (sign(t) * sqrt(abs(t)) + 1.0) * 0.5 * (table.columns - 1.0);
}

// Texture coordinates of the light that falls on a pixel at that distance from the disc's middle.
vec2 bokeh_place(BokehTable table, float radius_px, float distance_px) {
    return vec2((bokeh_column(table, radius_px) + 0.5) / table.columns,
                (distance_px * table.rows_per_px + 0.5) / table.rows);
}
