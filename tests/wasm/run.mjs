// Prints the hash that the WebAssembly module gives.
import { readFile } from "node:fs/promises";
const { instance } = await WebAssembly.instantiate(await readFile(process.argv[2]), {});
console.log(BigInt.asUintN(64, instance.exports.hash()).toString());
