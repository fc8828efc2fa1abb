import { AddEquation, BufferAttribute, Camera, CustomBlending, GLSL3, HalfFloatType, InstancedBufferGeometry, Mesh, NearestFilter, NoBlending, OneFactor, RawShaderMaterial, Scene, Vector2, Vector3, WebGLRenderTarget } from "three";
import * as shaders from "./shaders.js";

const DEFAULTS = { fStop: 2, focusDistance: 2, sensorWidth: 36, metresPerUnit: 1, maxRadius: 32, taps: 96, lampFactor: 8 };
const NEEDED_ATLAS = "no lens: load one by LensAtlas.load(folder) and set it as `atlas`; the picture stays sharp";
const NEEDED_DEPTH = "no depth texture: give the composer a render target with a DepthTexture, or set `depthTexture`; the picture stays sharp";

function quad(points, indices) {
  const made = new InstancedBufferGeometry();
  made.setAttribute("position", new BufferAttribute(new Float32Array(points), 3));
  made.setAttribute("uv", new BufferAttribute(new Float32Array(points.flatMap((_, i) => (i % 3 ? [] : [(points[i] + 1) / 2, (points[i + 1] + 1) / 2]))), 2));
  if (indices) made.setIndex(indices);
  made.instanceCount = 1;
  return made;
}

/** Depth of field of a real lens, from a colour and a depth texture; LensPass and pmndrsLensPass put it into a composer. */
export class LensBlur {
  #targets = {};
  #materials = {};
  #whole = new Mesh(quad([-1, -1, 0, 3, -1, 0, -1, 3, 0]));
  #sprite = new Mesh(quad([-0.5, -0.5, 0, 0.5, -0.5, 0, 0.5, 0.5, 0, -0.5, 0.5, 0], [0, 1, 2, 0, 2, 3]));
  #scene = new Scene();
  #view = new Camera();
  #told = new Set();

  constructor(camera, options = {}) {
    Object.assign(this, { camera, atlas: null, depthTexture: null, ...DEFAULTS }, options);
    this.size = new Vector2(1, 1);
    for (const mesh of [this.#whole, this.#sprite]) mesh.frustumCulled = false;
  }

  /** Focal length in mm: that of the camera's field of view on this sensor; setting it changes the camera. */
  get focalLength() {
    return this.sensorWidth / this.camera.aspect / 2 / Math.tan((this.camera.fov * Math.PI) / 360);
  }
  set focalLength(mm) {
    this.camera.fov = (360 / Math.PI) * Math.atan(this.sensorWidth / this.camera.aspect / 2 / mm);
    this.camera.updateProjectionMatrix();
  }

  /** Focuses on what a ray through that place meets. @param {Vector2} place in -1…1, x right, y up @returns {boolean} false: nothing is there */
  focusAt(place, raycaster, objects) {
    this.camera.updateWorldMatrix(true, false);  // places are those of the last frame, if there was one
    for (const object of objects) object.updateWorldMatrix(true, true);
    raycaster.setFromCamera(place, this.camera);
    const [hit] = raycaster.intersectObjects(objects, true);
    if (!hit) return false;
    this.focusDistance = -hit.point.clone().applyMatrix4(this.camera.matrixWorldInverse).z * this.metresPerUnit;
    return true;
  }

  /** radius = x + y / distance in units; see docs/conventions.md. */
  optics() {
    const focal_m = this.focalLength / 1000, focus_m = Math.max(this.focusDistance, 1.01 * focal_m);
    const far = (this.size.x / (this.sensorWidth / 1000)) * (focal_m ** 2 / (2 * this.fStop * (focus_m - focal_m)));
    return new Vector3(far, (-far * focus_m) / this.metresPerUnit, this.maxRadius);
  }

  setSize(width, height) {
    this.size.set(Math.max(1, width), Math.max(1, height));
  }

  #tell(problem) {
    if (!this.#told.has(problem)) console.error(`petzval: ${problem}`);
    this.#told.add(problem);
  }

  #target(name, width, height, filter = NearestFilter, type = HalfFloatType) {
    const made = (this.#targets[name] ??= new WebGLRenderTarget(width, height, { type, minFilter: filter, magFilter: filter, depthBuffer: false }));
    made.setSize(width, height);
    return made;
  }

  #material(name, fragmentShader, vertexShader = shaders.WHOLE, blending = NoBlending) {
    const { header } = this.atlas ?? { header: { radii_px: [0, 0], zones: [0] } };
    const defines = { RADII_COUNT: header.radii_px.length, ZONES: header.zones.length, TAPS: this.taps };
    const key = `${name} ${Object.values(defines)}`;
    if (this.#materials[name]?.key !== key) {
      this.#materials[name]?.made.dispose();
      const head = vertexShader === shaders.WHOLE ? "in vec3 position; in vec2 uv;" : "in vec3 position;";
      const made = new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: head + vertexShader, fragmentShader, defines, uniforms: {}, blending, depthTest: false, depthWrite: false, toneMapped: false });
      if (blending === CustomBlending) Object.assign(made, { blendEquation: AddEquation, blendSrc: OneFactor, blendDst: OneFactor });
      this.#materials[name] = { key, made };
    }
    return this.#materials[name].made;
  }

  #draw(renderer, target, mesh, material, uniforms) {
    for (const [name, value] of Object.entries(uniforms)) material.uniforms[name] = { value };
    material.uniformsNeedUpdate = true;
    mesh.material = material;
    this.#scene.clear();
    this.#scene.add(mesh);
    renderer.setRenderTarget(target);
    renderer.render(this.#scene, this.#view);
  }

  /** What is missing, or nothing. */
  #problem(renderer, depth) {
    if (!this.atlas) return NEEDED_ATLAS;
    if (!depth) return NEEDED_DEPTH;
    if (!this.camera.isPerspectiveCamera) return "the camera must be a PerspectiveCamera; the picture stays sharp";
    if (renderer.capabilities.logarithmicDepthBuffer) return "logarithmicDepthBuffer is not supported; the picture stays sharp";
    return null;
  }

  /** Draws the blurred picture into a target, or the screen where it is null. */
  render(renderer, colour, depth, output) {
    const autoClear = renderer.autoClear, problem = this.#problem(renderer, depth);
    renderer.autoClear = false;
    if (problem) this.#tell(problem);
    const gathered = problem ? colour : this.#blurred(renderer, colour, depth);
    this.#draw(renderer, output, this.#whole, this.#material("finish", shaders.FINISH), { gathered, colour });
    renderer.autoClear = autoClear;
  }

  #blurred(renderer, colour, depth) {
    const { x: width, y: height } = this.size, tilesX = Math.ceil(width / 16), tilesY = Math.ceil(height / 16);
    const { header, texels: atlas, numbers } = this.atlas;
    const pixel = width / header.camera.width, lens = new Vector3(header.radii_px.at(-1) * pixel, header.tile.side, pixel);
    const e = this.camera.projectionMatrix.elements;
    const unproject = renderer.capabilities.reversedDepthBuffer ? new Vector2(e[14], e[10]) : new Vector2(e[14] / 2, (e[10] - 1) / 2);
    const whole = (target, name, shader, uniforms) => (this.#draw(renderer, target, this.#whole, this.#material(name, shader), uniforms), target.texture);
    const split = whole(this.#target("split", width, height), "radii", shaders.RADII, { colour, depth, optics: this.optics(), unproject });
    const tiles = whole(this.#target("tiles", tilesX, tilesY), "tiles", shaders.TILES, { split });
    const reach = whole(this.#target("reach", tilesX, tilesY), "reach", shaders.REACH, { tiles, around: Math.ceil((1.3 * this.maxRadius) / 16) + 1 });
    const rest = whole(this.#target("rest", width, height), "without lamps", shaders.WITHOUT_LAMPS, { split, lamp_factor: this.lampFactor });
    const taken = whole(this.#target("taken", width, height), "gather", shaders.GATHER, { split: rest, reach, atlas, numbers, lens });
    const gathered = whole(this.#target("gathered", width, height), "mean", shaders.MEAN, { split: rest, gathered: taken });
    if (this.lampFactor <= 0) return gathered;
    // Sums of lamps apart: a target is not read while it is drawn into.
    const sum = this.#target("sum", width, height);
    whole(sum, "copy", shaders.FINISH, { gathered, colour: gathered });
    const across = Math.ceil(width / 2);
    this.#sprite.geometry.instanceCount = across * Math.ceil(height / 2);
    this.#draw(renderer, sum, this.#sprite, this.#material("sprites", shaders.SPRITES.fragment, shaders.SPRITES.vertex, CustomBlending),
      { split, gathered, atlas, numbers, lens, lamp_factor: this.lampFactor, across });
    return sum.texture;
  }

  dispose() {
    for (const target of Object.values(this.#targets)) target.dispose();
    for (const { made } of Object.values(this.#materials)) made.dispose();
    for (const mesh of [this.#whole, this.#sprite]) mesh.geometry.dispose();
  }
}
