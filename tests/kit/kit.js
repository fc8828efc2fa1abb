// A host of the shader kit on WebGPU: draws one frame by its WGSL and its kit.json, by docs/explain/shader-kit.md
// alone, and returns the floats.
const TILE = 16, PUSH = 64, SAMPLER = 32;

// Bindings that a program uses: a declaration that nothing uses is in no automatic layout.
function used(wgsl) {
  const found = [...wgsl.matchAll(/@group\(0\) @binding\((\d+)\)\s*var(?:<[^>]*>)? (\w+): ([^;]+);/g)];
  return found.filter(([, , name]) => wgsl.match(new RegExp(`\\b${name}\\b`, "g")).length > 1)
              .map(([, binding]) => Number(binding));
}

// The push block as bytes, from values by name.
function pushed(members, values) {
  const bytes = new ArrayBuffer(64);
  for (const { offset, type, name } of members) {
    const Floats = { float: Float32Array, vec2: Float32Array, int: Int32Array, ivec2: Int32Array, uint: Uint32Array }[type];
    const given = [values[name]].flat();
    new Floats(bytes, offset, given.length).set(given);
  }
  return bytes;
}

async function draw({ width, height, mostPx, programs, kit, lens, colour, radii }) {
  const mark = new TextDecoder().decode(lens.slice(16, 20));
  if (mark !== kit.lens_mark) throw new Error(`lens.bin is not for this kit: its bytes 16 to 19 are not ${kit.lens_mark}`);
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) return null;
  const device = await adapter.requestDevice();
  device.pushErrorScope("validation");
  const across = Math.ceil(width / TILE), down = Math.ceil(height / TILE), tiles = across * down;
  const { TEXTURE_BINDING, STORAGE_BINDING, COPY_DST, COPY_SRC } = GPUTextureUsage;
  const texture = (format, size, usage, mipLevelCount = 1) => device.createTexture({ format, size, usage, mipLevelCount });
  const given = (format, values, bytes) => {
    const made = texture(format, [width, height], TEXTURE_BINDING | COPY_DST);
    device.queue.writeTexture({ texture: made }, values, { bytesPerRow: bytes * width }, [width, height]);
    return made;
  };
  const buffer = (size, values, usage = GPUBufferUsage.STORAGE) => {
    const made = device.createBuffer({ size, usage: usage | GPUBufferUsage.COPY_DST });
    if (values) device.queue.writeBuffer(made, 0, values);
    return made;
  };
  const own = TEXTURE_BINDING | STORAGE_BINDING;
  const resources = {
    colour: given("rgba32float", colour, 16), depth: given("r32float", radii, 4),  // depth is the radius
    cells: texture("rgba16float", [8 * across, 8 * down, 5], own, 4),
    gathered: texture("rgba16float", [8 * across, 8 * down, 3], own),
    result: texture("rgba32float", [width, height], STORAGE_BINDING | COPY_SRC),
    lens: buffer(lens.byteLength, lens), surroundings: buffer(8 * tiles), cell_lamps: buffer(1024 * tiles),
  };
  resources.layer = resources.colour;
  for (const name of ["tiles", "reach", "lamps", "kept", "boxes"]) resources[name] = buffer(16 * tiles);
  const constants = buffer(64, pushed(kit.push, {
    size: [width, height], tiles: [across, down], add_px: 0, per_depth_px: 1, most_px: mostPx, aspect: 1, has_layer: 0,
    exposure: 1, zone_scale: [1 / width, 1 / height], zone_add: [0, 0], view: 0 }), GPUBufferUsage.UNIFORM);
  const linear = device.createSampler({ magFilter: "linear", minFilter: "linear", mipmapFilter: "linear" });
  const of = ({ resource, kind, level }) => {
    const made = resources[resource];
    if (kind === "buffer") return { buffer: made };
    const dimension = resource === "cells" || resource === "gathered" ? "2d-array" : "2d";
    return made.createView(level === undefined ? { dimension } : { dimension, baseMipLevel: level, mipLevelCount: 1 });
  };
  const groups = { "tiles": [across, down], "tiles / 64": [Math.ceil(tiles / 64), 1], "pixels / 8": [Math.ceil(width / 8), Math.ceil(height / 8)] };
  const commands = device.createCommandEncoder();
  for (const { name, bindings, groups: count } of kit.programs.filter((one) => one.name in programs)) {
    const code = programs[name];
    const pipeline = device.createComputePipeline({ layout: "auto", compute: { module: device.createShaderModule({ code }) } });
    const entries = used(code).map((binding) => ({ binding, resource: binding === PUSH ? { buffer: constants }
      : binding >= SAMPLER ? linear : of(bindings.find((one) => one.binding === binding)) }));
    const pass = commands.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
    pass.dispatchWorkgroups(...groups[count]);
    pass.end();
  }
  const bytesPerRow = 256 * Math.ceil(width * 16 / 256);
  const read = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
  commands.copyTextureToBuffer({ texture: resources.result }, { buffer: read, bytesPerRow }, [width, height]);
  device.queue.submit([commands.finish()]);
  const refused = await device.popErrorScope();
  if (refused) throw new Error(refused.message);
  await read.mapAsync(GPUMapMode.READ);
  const rows = new Float32Array(read.getMappedRange()), made = new Float32Array(4 * width * height);
  for (let y = 0; y < height; ++y) made.set(rows.subarray(y * bytesPerRow / 4, y * bytesPerRow / 4 + 4 * width), 4 * width * y);
  return made;
}
