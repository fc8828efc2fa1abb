import { DataTexture, Object3D, PerspectiveCamera, Raycaster, Texture, Vector2, Vector3, WebGLRenderer, WebGLRenderTarget } from "three";
import { Pass } from "three/addons/postprocessing/Pass.js";

/** A lens: what `petzval lens atlas` wrote. */
export class LensAtlas {
  constructor(header: object, bytes: ArrayBuffer, url?: string);
  static load(folder: string): Promise<LensAtlas>;
  readonly header: { name: string; lens: string; camera: { focal_length_mm: number; f_number: number; sensor_width_mm: number; width: number; height: number } };
  readonly texels: DataTexture;
  readonly numbers: DataTexture;
  dispose(): void;
}

export interface LensOptions {
  atlas?: LensAtlas | null;
  /** Null: that of the composer's render target. */
  depthTexture?: Texture | null;
  fStop?: number;
  /** Metres. */
  focusDistance?: number;
  /** Millimetres. */
  sensorWidth?: number;
  metresPerUnit?: number;
  /** Pixels; larger radii are cut. */
  maxRadius?: number;
  taps?: number;
  /** A lamp is so many times as bright as what is around; 0: no lamps. */
  lampFactor?: number;
}

export class LensBlur implements LensOptions {
  constructor(camera: PerspectiveCamera, options?: LensOptions);
  camera: PerspectiveCamera;
  atlas: LensAtlas | null;
  depthTexture: Texture | null;
  fStop: number;
  focusDistance: number;
  sensorWidth: number;
  metresPerUnit: number;
  maxRadius: number;
  taps: number;
  lampFactor: number;
  /** Millimetres; setting it changes the camera's field of view. */
  focalLength: number;
  focusAt(place: Vector2, raycaster: Raycaster, objects: Object3D[]): boolean;
  optics(): Vector3;
  setSize(width: number, height: number): void;
  render(renderer: WebGLRenderer, colour: Texture, depth: Texture | null, output: WebGLRenderTarget | null): void;
  dispose(): void;
}

export class LensPass extends Pass {
  constructor(camera: PerspectiveCamera, options?: LensOptions);
  readonly lens: LensBlur;
}

/** A pass for pmndrs' EffectComposer, with Pass of the package postprocessing. */
export function pmndrsLensPass<P>(pass: new (name?: string) => P, camera: PerspectiveCamera, options?: LensOptions): P & { readonly lens: LensBlur };
