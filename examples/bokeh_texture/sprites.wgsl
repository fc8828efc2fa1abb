// sprites.frag in WGSL, behind bokeh_texture.wgsl.
struct At {
    table: BokehTable,
    size: vec2<f32>,
}
@group(0) @binding(1) var table: texture_2d<f32>;
@group(0) @binding(2) var table_sampler: sampler;
@group(0) @binding(3) var<uniform> at: At;

@fragment
fn main(@location(0) @interpolate(flat) radius_px: f32,
        @location(1) from_middle_px: vec2<f32>) -> @location(0) vec4<f32> {
    var sum = vec3<f32>(0.0);
    for (var i = 0; i < 16; i++) {
        let at_px = from_middle_px + (vec2<f32>(f32(i % 4), f32(i / 4)) - 1.5) / 4.0;
        sum += textureSampleLevel(table, table_sampler, bokeh_place(at.table, radius_px, length(at_px)), 0.0).rgb;
    }
    return vec4<f32>(sum / 16.0, 1.0);
}
