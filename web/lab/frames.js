// The worker of frames as promises.

export class Frames {
  #worker; #open = new Map(); #last = 0; #ended = null;

  constructor() {
    this.#worker = new Worker(new URL("./picture-worker.js", import.meta.url), { type: "module" });
    this.#worker.onmessage = ({ data }) => (data.broken ? this.end(data.broken) : this.#told(data));
    this.#worker.onerror = (event) => this.end(event.message || "its worker could not be started");
  }

  /** @returns {Promise<{result: any, ms: number}>} of a call of picture-worker.js */
  ask(call, args, progressed = null) {
    if (this.#ended) return Promise.reject(new Error(this.#ended));
    const id = ++this.#last;
    return new Promise((resolve, reject) => {
      this.#open.set(id, { resolve, reject, progressed });
      this.#worker.postMessage({ id, call, args });
    });
  }

  /** Ends the thread whatever it does; what it was asked is refused with this sentence. */
  end(sentence) {
    this.#worker.terminate();
    this.#ended = sentence;
    for (const { reject } of this.#open.values()) reject(new Error(sentence));
    this.#open.clear();
  }

  #told({ id, result, ms, error, done }) {
    const { resolve, reject, progressed } = this.#open.get(id);
    if (done !== undefined) return progressed?.(done);
    this.#open.delete(id);
    if (error) reject(new Error(error));
    else resolve({ result, ms });
  }
}
