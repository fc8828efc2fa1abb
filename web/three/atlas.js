import { DataTexture, DataUtils, HalfFloatType, LinearFilter, NoColorSpace, RGBAFormat, RGBFormat, UnsignedInt5999Type } from "three";

const wrong = (url, why) => new Error(`petzval: the lens atlas ${url} ${why}`);

async function fetched(url) {
  const answer = await fetch(url).catch((error) => { throw wrong(url, `cannot be loaded: ${error.message}`); });
  if (!answer.ok) throw wrong(url, `cannot be loaded: ${answer.status} ${answer.statusText}`);
  return answer;
}

function check(url, header, bytes) {
  if (header?.format !== "petzval lens atlas" || header.version !== 1) throw wrong(url, "is not a lens atlas of version 1");
  const { zones, radii_px, sides_px, sums, texels, tile } = header;
  const shaped = (rows) => rows?.length === zones?.length && rows.every((row) => row.length === radii_px?.length);
  if (!zones?.length || !shaped(sides_px) || !shaped(sums) || texels.width !== tile.side * radii_px.length || texels.height !== tile.side * zones.length)
    throw wrong(url, "has a damaged header");
  if (bytes.byteLength !== 4 * texels.width * texels.height) throw wrong(url, `needs ${4 * texels.width * texels.height} bytes of texels, not ${bytes.byteLength}`);
}

function numbersOf({ zones, radii_px, sides_px, sums }) {
  const values = new Uint16Array(4 * zones.length * radii_px.length);
  zones.forEach((_, z) => radii_px.forEach((_, r) => {
    const numbers = [...sums[z][r].map((sum) => 1 / Math.max(sum, 1e-3)), sides_px[z][r]];
    values.set(numbers.map((value) => DataUtils.toHalfFloat(value)), 4 * (z * radii_px.length + r));
  }));
  return values;
}

function texture(data, width, height, format, type) {
  const made = new DataTexture(data, width, height, format, type);
  made.minFilter = made.magFilter = LinearFilter;
  made.colorSpace = NoColorSpace;
  made.needsUpdate = true;
  return made;
}

/** A lens: what `petzval lens atlas` wrote. */
export class LensAtlas {
  /** @param {object} header of atlas.json @param {ArrayBuffer} bytes of atlas.bin @throws {Error} if they are damaged */
  constructor(header, bytes, url = "") {
    check(url, header, bytes);
    this.header = header;
    const { texels, radii_px, zones } = header;
    this.texels = texture(new Uint32Array(bytes), texels.width, texels.height, RGBFormat, UnsignedInt5999Type);
    this.numbers = texture(numbersOf(header), radii_px.length, zones.length, RGBAFormat, HalfFloatType);
  }

  /** Loads FOLDER/atlas.json and atlas.bin. @throws {Error} with one sentence */
  static async load(folder) {
    const url = `${folder.replace(/\/$/, "")}/atlas.json`;
    const text = await (await fetched(url)).text();
    let header;
    try {
      header = JSON.parse(text);
    } catch {
      throw wrong(url, "is not JSON");
    }
    if (typeof header?.texels?.file !== "string") throw wrong(url, "is not a lens atlas of version 1");
    const bytes = await (await fetched(`${folder.replace(/\/$/, "")}/${header.texels.file}`)).arrayBuffer();
    return new LensAtlas(header, bytes, url);
  }

  dispose() {
    this.texels.dispose();
    this.numbers.dispose();
  }
}
