// sprites.frag in HLSL.
#include "bokeh_texture.hlsl"
[[vk::binding(1)]] Texture2D table;
[[vk::binding(2)]] SamplerState table_sampler;
[[vk::binding(3)]] cbuffer At {
    float4 numbers;
    float2 size;
};

float4 main([[vk::location(0)]] nointerpolation float radius_px : TEXCOORD0,
            [[vk::location(1)]] float2 from_middle_px : TEXCOORD1) : SV_Target0 {
    BokehTable at;
    at.columns = numbers.x;
    at.rows = numbers.y;
    at.rows_per_px = numbers.z;
    at.largest_radius_px = numbers.w;
    float3 sum = 0;
    for (int i = 0; i < 16; ++i) {
        float2 at_px = from_middle_px + (float2(i % 4, i / 4) - 1.5) / 4;
        sum += table.SampleLevel(table_sampler, bokeh_place(at, radius_px, length(at_px)), 0).rgb;
    }
    return float4(sum / 16, 1);
}
