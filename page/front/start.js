"use strict";
// The library out of the page itself: base64, gzip, WebAssembly.
async function openLibrary() {
  // The first is the faster, and newer.
  const packed = Uint8Array.fromBase64?.(LIBRARY) ?? Uint8Array.from(atob(LIBRARY), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  await wasm_bindgen({ module_or_path: await new Response(stream).arrayBuffer() });
}

const byId = (id) => document.getElementById(id);

// Calls `f` once nothing has happened for the given number of milliseconds.
function later(milliseconds, f) {
  let timer = 0;
  return (...list) => {
    clearTimeout(timer);
    timer = setTimeout(() => f(...list), milliseconds);
  };
}

// A place in bytes of UTF-8 as one in a string of JavaScript.
function placeInString(text, bytes) {
  let seen = 0, at = 0;
  for (const c of text) {
    if (seen >= bytes) break;
    const code = c.codePointAt(0);
    seen += code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    at += c.length;
  }
  return at;
}

// The names that people write for Greek letters, and indices below.
const GREEK = { Pi: "Π", Gamma: "Γ", Omega: "Ω", mu: "μ", pi: "π", gamma: "γ", omega: "ω", alpha: "α", beta: "β", xi: "ξ", nu: "ν" };
const BELOW = { 0: "₀", 1: "₁", 2: "₂", 3: "₃", 4: "₄", 5: "₅", 6: "₆", 7: "₇", 8: "₈", 9: "₉", x: "ₓ" };
function nicely(name) {
  const [, head, tail] = /^(\p{L}*)(.*)$/u.exec(name);
  const below = [...tail.replace(/[_[\]]/g, "")].map((c) => BELOW[c] ?? c).join("");
  return (GREEK[head] ?? head) + below;
}

// A number for people: three digits, and powers of ten where there are many zeros.
function shortly(x, digits = 3) {
  if (!Number.isFinite(x)) return "not finite";
  if (x === 0) return "0";
  const size = Math.abs(x);
  const text = size >= 1e-3 && size < 1e5 ? String(+x.toPrecision(digits)) : x.toExponential(digits - 1);
  return text.replace("-", "−").replace("e+", "e");
}
