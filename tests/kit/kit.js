// A host of the shader kit on WebGPU: draws one frame by its WGSL (docs/explain/shader-kit.md) and returns the floats.
const TILE = 16, PUSH = 64, SAMPLER = 32;

// Names, bindings and types of what a program uses; a declaration that nothing uses is in no layout.
function used(wgsl) {
  const found = [...wgsl.matchAll(/@group\(0\) @binding\((\d+)\)\s*var(?:<[^>]*>)? (\w+): ([^;]+);/g)];
  return found.filter(([, , name]) => wgsl.match(new RegExp(`\\b${name}\\b`, "g")).length > 1)
              .map(([, binding, , type]) => ({ binding: Number(binding), type }));
}

async function draw({ width, height, mostPx, programs, lens, colour, radii }) {
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
  const colours = given("rgba32float", colour, 16), depths = given("r32float", radii, 4);
  const cells = texture("rgba16float", [8 * across, 8 * down, 5], own, 4), gathered = texture("rgba16float", [8 * across, 8 * down, 3], own);
  const result = texture("rgba32float", [width, height], STORAGE_BINDING | COPY_SRC);
  const whole = (made) => made.createView({ dimension: "2d-array" });
  const level = (baseMipLevel) => cells.createView({ dimension: "2d-array", baseMipLevel, mipLevelCount: 1 });
  const surroundings = buffer(8 * tiles), cellLamps = buffer(1024 * tiles);
  const [radiiOfTiles, reach, lamps, boxes, kept] = [0, 1, 2, 3, 4].map(() => buffer(16 * tiles));
  const push = new ArrayBuffer(64);
  new Int32Array(push, 0, 4).set([width, height, across, down]);
  new Float32Array(push, 16, 4).set([0, 1, mostPx, 1]);  // depth is the radius
  new Float32Array(push, 36, 1).set([1]);
  const linear = device.createSampler({ magFilter: "linear", minFilter: "linear", mipmapFilter: "linear" });
  const shapes = { buffer: buffer(lens.byteLength, lens) }, of = (made) => ({ buffer: made });
  const bound = {
    measure: { 0: colours.createView(), 1: of(surroundings) },
    split: { 0: colours.createView(), 1: depths.createView(), 2: level(0), 3: level(1), 4: level(2), 5: level(3),
             6: of(radiiOfTiles), 7: of(surroundings), 8: of(lamps), 9: of(cellLamps) },
    reach: { 0: of(radiiOfTiles), 1: of(reach), 2: of(lamps), 3: of(boxes), 4: of(kept), 5: of(cellLamps) },
    gather: { 0: whole(cells), 1: shapes, 2: of(reach), 3: whole(gathered) },
    combine_32: { 0: colours.createView(), 1: whole(cells), 2: colours.createView(), 3: whole(gathered), 4: result.createView(),
                  5: shapes, 6: of(kept), 7: of(boxes), 8: of(reach), 9: of(cellLamps) },
  };
  const constants = of(buffer(64, push, GPUBufferUsage.UNIFORM));
  const groups = { measure: [across, down], split: [across, down], reach: [Math.ceil(tiles / 64), 1], gather: [across, down],
                   combine_32: [Math.ceil(width / 8), Math.ceil(height / 8)] };
  const commands = device.createCommandEncoder();
  for (const [name, resources] of Object.entries(bound)) {
    const pipeline = device.createComputePipeline({ layout: "auto", compute: { module: device.createShaderModule({ code: programs[name] }) } });
    const resource = (binding) => binding === PUSH ? constants : binding >= SAMPLER ? linear : resources[binding];
    const entries = used(programs[name]).map(({ binding }) => ({ binding, resource: resource(binding) }));
    const pass = commands.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
    pass.dispatchWorkgroups(...groups[name]);
    pass.end();
  }
  const bytesPerRow = 256 * Math.ceil(width * 16 / 256);
  const read = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
  commands.copyTextureToBuffer({ texture: result }, { buffer: read, bytesPerRow }, [width, height]);
  device.queue.submit([commands.finish()]);
  const refused = await device.popErrorScope();
  if (refused) throw new Error(refused.message);
  await read.mapAsync(GPUMapMode.READ);
  const rows = new Float32Array(read.getMappedRange()), made = new Float32Array(4 * width * height);
  for (let y = 0; y < height; ++y) made.set(rows.subarray(y * bytesPerRow / 4, y * bytesPerRow / 4 + 4 * width), 4 * width * y);
  return made;
}
