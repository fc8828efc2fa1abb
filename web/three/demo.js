import * as THREE from "three";
import { EffectComposer } from "three/addons/postprocessing/EffectComposer.js";
import { OutputPass } from "three/addons/postprocessing/OutputPass.js";
import { RenderPass } from "three/addons/postprocessing/RenderPass.js";
import { LensAtlas, LensPass } from "./index.js";

const find = (id) => document.getElementById(id);

/** Balls on a floor, lamps behind and before them; the same at every call. */
function makeScene() {
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0.01, 0.013, 0.03);
  const add = (geometry, material, x, y, z) => { const mesh = new THREE.Mesh(geometry, material); mesh.position.set(x, y, z); scene.add(mesh); return mesh; };
  const plain = (colour) => new THREE.MeshStandardMaterial({ color: colour, roughness: 0.6 });
  add(new THREE.PlaneGeometry(60, 60), plain(0x55504a), 0, -0.5, -20).rotation.x = -Math.PI / 2;
  const ball = new THREE.SphereGeometry(0.28, 48, 32);
  [[-1.1, -3.2, 0xb03020], [-0.35, -2.4, 0xc89030], [0.3, -2, 0x3f7fb0], [0.95, -1.5, 0x50a050], [1.9, -6, 0x8050a0]]
    .forEach(([x, z, colour]) => add(ball, plain(colour), x, -0.22, z));
  const bulb = new THREE.SphereGeometry(0.025, 12, 8);
  let seed = 7;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  for (let i = 0; i < 70; i++) {
    const light = new THREE.Color().setHSL(random() * 0.16 + (random() < 0.2 ? 0.5 : 0), 0.8, 0.6).multiplyScalar(18);
    add(bulb, new THREE.MeshBasicMaterial({ color: light }), random() * 12 - 6, random() * 3.4 - 0.3, -7 - random() * 8);
  }
  scene.add(new THREE.HemisphereLight(0x8090b0, 0x302820, 1.2));
  const key = new THREE.DirectionalLight(0xffe0c0, 2.5);
  key.position.set(2, 4, 3);
  scene.add(key);
  return scene;
}

class Demo {
  constructor(canvas) {
    const { width, height } = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: false });
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.renderer.setSize(width, height, false);
    this.camera = new THREE.PerspectiveCamera(40, width / height, 0.1, 100);
    this.camera.position.set(0, 0.25, 0);
    this.scene = makeScene();
    this.lensPass = new LensPass(this.camera);
    this.lens = this.lensPass.lens;
    this.lens.focalLength = 70;
    this.lens.fStop = 1.4;
    this.resize(width, height);
  }

  resize(width, height) {
    const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.HalfFloatType, depthTexture: new THREE.DepthTexture(width, height, THREE.FloatType) });
    this.composer = new EffectComposer(this.renderer, target);
    for (const pass of [new RenderPass(this.scene, this.camera), this.lensPass, new OutputPass()]) this.composer.addPass(pass);
  }

  draw() {
    this.composer.render();
    find("focus-value").textContent = `${this.lens.focusDistance.toFixed(2)} m`;
    find("focus").value = this.lens.focusDistance;
    find("f-value").textContent = this.lens.fStop.toFixed(1);
    find("focal-value").textContent = Math.round(this.lens.focalLength);
  }

  async use(name) {
    this.lens.atlas = await LensAtlas.load(`lenses/${name}`);
  }

  /** For tests: light, planar metres and the blurred light, rows from the top, of four floats a pixel. */
  buffers(width, height) {
    const { renderer, scene, camera } = this;
    const make = (depth) => new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, ...depth });
    const sharp = make({ depthTexture: new THREE.DepthTexture(width, height, THREE.FloatType) }), metres = make(), blurred = make();
    renderer.setRenderTarget(sharp);
    renderer.clear();
    renderer.render(scene, camera);
    const { background } = scene, far = camera.far;
    scene.background = null;
    scene.overrideMaterial = new THREE.ShaderMaterial({
      vertexShader: "varying float z; void main() { vec4 p = modelViewMatrix * vec4(position, 1.0); z = -p.z; gl_Position = projectionMatrix * p; }",
      fragmentShader: "varying float z; void main() { gl_FragColor = vec4(z); }" });
    renderer.setRenderTarget(metres);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.render(scene, camera);
    Object.assign(scene, { background, overrideMaterial: null });
    this.lens.setSize(width, height);
    this.lens.render(renderer, sharp.texture, sharp.depthTexture, blurred);
    return Object.fromEntries(Object.entries({ sharp, metres, blurred }).map(([name, target]) => {
      const read = new Float32Array(4 * width * height), rows = new Float32Array(read.length);
      renderer.readRenderTargetPixels(target, 0, 0, width, height, read);
      for (let y = 0; y < height; y++) rows.set(read.subarray(4 * width * (height - 1 - y), 4 * width * (height - y)), 4 * width * y);
      if (name === "metres") for (let i = 0; i < rows.length; i++) rows[i] ||= far;
      return [name, rows];
    }));
  }
}

async function start() {
  const demo = (window.demo = new Demo(find("view")));
  const names = await (await fetch("lenses/index.json")).json();
  find("lens").replaceChildren(...names.map((name) => new Option(name, name)));
  const changed = (id, set) => find(id).addEventListener("input", async () => { await set(find(id).value); demo.draw(); });
  changed("lens", (name) => demo.use(name));
  changed("f", (value) => { demo.lens.fStop = Number(value); });
  changed("focal", (value) => { demo.lens.focalLength = Number(value); });
  changed("focus", (value) => { demo.lens.focusDistance = Number(value); });
  find("view").addEventListener("click", (event) => {
    const box = event.target.getBoundingClientRect();
    const place = new THREE.Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    if (demo.lens.focusAt(place, new THREE.Raycaster(), demo.scene.children)) demo.draw();
  });
  await demo.use(names[0]);
  demo.draw();
}

start().catch((error) => {
  find("problem").hidden = false;
  find("problem").textContent = error.message;
}).finally(() => find("lab").setAttribute("aria-busy", "false"));
