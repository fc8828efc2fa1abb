import { Pass } from "three/addons/postprocessing/Pass.js";
import { LensBlur } from "./lens-blur.js";

export { LensAtlas } from "./atlas.js";
export { LensBlur } from "./lens-blur.js";

/** A pass for three's EffectComposer. `lens` is the LensBlur with all settings. */
export class LensPass extends Pass {
  constructor(camera, options) {
    super();
    this.lens = new LensBlur(camera, options);
  }
  setSize(width, height) {
    this.lens.setSize(width, height);
  }
  render(renderer, writeBuffer, readBuffer) {
    this.lens.render(renderer, readBuffer.texture, this.lens.depthTexture ?? readBuffer.depthTexture, this.renderToScreen ? null : writeBuffer);
  }
  dispose() {
    this.lens.dispose();
  }
}

/** A pass for pmndrs' EffectComposer: `pmndrsLensPass(Pass, camera, options)` with Pass of the package postprocessing. */
export function pmndrsLensPass(Pass, camera, options) {
  const lens = new LensBlur(camera, options);
  return new (class extends Pass {
    constructor() {
      super("LensPass");
      this.lens = lens;
      this.needsDepthTexture = true;
    }
    setDepthTexture(texture) {
      lens.depthTexture = texture;
    }
    setSize(width, height) {
      lens.setSize(width, height);
    }
    render(renderer, input, output) {
      lens.render(renderer, input.texture, lens.depthTexture, this.renderToScreen ? null : output);
    }
    dispose() {
      lens.dispose();
    }
  })();
}
