// Reads the USD files that tests/full/readers.sh exported by TinyUSDZ, which checks types and names, and leaves what it saw in usd.json.
// In that script's folder: `moving`, five frames, and its frame 4 alone in `last`.
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

globalThis.window = globalThis;  // the package is built for browsers alone
process.type = 'renderer';
const folder = process.cwd() + '/package/';
const { default: start } = await import(pathToFileURL(folder + 'tinyusdz.js'));
const native = await start({ wasmBinary: readFileSync(folder + 'tinyusdz.wasm') });

const bytes = (run) => new Uint8Array(readFileSync(run + '/export/cantilever.usda'));
const check = (reader, ok) => { if (!ok) throw new Error(reader.error()); return reader; };

/// What it makes of the first frame of a file.
function stage(run) {
  const reader = new native.TinyUSDZLoaderNative();
  check(reader, reader.loadFromBinary(bytes(run), run));
  const mesh = reader.getMesh(0);
  const arrays = ['faceVertexCounts', 'faceVertexIndices', 'points', 'normals'].map((name) => [name, Array.from(mesh[name])]);
  return { meshes: reader.numMeshes(), ...Object.fromEntries(arrays), material: reader.getMaterial(mesh.materialId) };
}

/// The file as it has understood it, in its own words.
const layer = new native.TinyUSDZLoaderNative();
check(layer, layer.loadAsLayerFromBinary(bytes('moving'), 'moving'));
const text = layer.layerToString();
const number = (name) => Number(text.match(new RegExp(`^ *(?:float )?${name} = (\\S+)$`, 'm'))[1]);
const numbers = (list) => list.match(/[-+.\de]+/g).map(Number);
function samples(attribute) {
  const lines = text.match(new RegExp(`\\] ${attribute}\\.timeSamples = {\n([^}]*)}`))[1].trim().split('\n');
  return Object.fromEntries(lines.map((line) => line.split(': ')).map(([time, list]) => [Number(time), numbers(list)]));
}

const header = ['startTimeCode', 'endTimeCode', 'timeCodesPerSecond', 'framesPerSecond', 'metersPerUnit', 'focalLength', 'verticalAperture'];
writeFileSync('usd.json', JSON.stringify({
  moving: stage('moving'),
  last: stage('last'),
  header: Object.fromEntries(header.map((name) => [name, number(name)])),
  samples: Object.fromEntries(['points', 'normals', 'extent', 'primvars:von_mises'].map((name) => [name, samples(name)])),
}));
