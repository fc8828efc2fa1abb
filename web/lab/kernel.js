// The kernel worker as promises.

/** A call that a newer one of its slot replaced. */
export class Replaced extends Error {}

export class Kernel {
  #worker = new Worker(new URL("./kernel-worker.js", import.meta.url), { type: "module" });
  #open = new Map();
  #last = 0;

  constructor() {
    this.ready = new Promise((resolve, reject) => {
      this.#worker.onmessage = ({ data }) => {
        if (data.ready) resolve();
        else if (data.broken) reject(new Error(data.broken));
        else this.#settle(data);
      };
      this.#worker.onerror = (event) => reject(new Error(event.message || "the worker could not be started"));
    });
  }

  /** @returns {Promise<{result: any, ms: number}>} of a call of kernel-worker.js. @param {?string} slot see there */
  ask(call, args = {}, slot = null) {
    const id = ++this.#last;
    return new Promise((resolve, reject) => {
      this.#open.set(id, { resolve, reject });
      this.#worker.postMessage({ id, call, args, slot });
    });
  }

  #settle({ id, result, ms, error, replaced }) {
    const { resolve, reject } = this.#open.get(id);
    this.#open.delete(id);
    if (replaced) reject(new Replaced());
    else if (error) reject(new Error(error));
    else resolve({ result, ms });
  }
}
