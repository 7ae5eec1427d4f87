// Begins a page in one file: its modules and frames are unpacked, and modules find one another by addresses made for them.

async function unpacked(id) {
  const packed = Uint8Array.from(atob(document.getElementById(id).textContent), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const whole = await new Response(stream).arrayBuffer();
  const length = new DataView(whole).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(whole, 4, length)));
  return { head, bytes: new Uint8Array(whole, 4 + length) };
}

try {
  window.carried = await unpacked("frames");
  const { head: sources } = await unpacked("code");
  const places = {};
  const needs = (text) => [...text.matchAll(/from "\.\/([^"]+)"/g)].map(([, name]) => name);
  let left = Object.keys(sources);
  while (left.length) {
    const next = left.find((name) => needs(sources[name]).every((other) => places[other]));
    const text = sources[next].replace(/from "\.\/([^"]+)"/g, (_, name) => `from "${places[name]}"`);
    places[next] = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    left = left.filter((name) => name !== next);
  }
  await import(places["main.js"]);
} catch (error) {
  const message = document.getElementById("message");
  message.textContent = `The grains cannot be shown here: ${error.message}`;
  message.hidden = false;
}
