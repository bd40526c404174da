// Unpacks what xz packed, of several kinds and settings: prints the number of inputs, of those that differ, and of
// those that were cut short without an error. The argument is the script that unpacks.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";

const unlzma = new Function(readFileSync(process.argv[2], "utf8") + "; return unlzma;")();
let seed = 1;
const random = () => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648;
const settings = ["preset=9e", "preset=0", "preset=6,lc=0,lp=2,pb=0", "preset=6,lc=4,lp=0,pb=4", "preset=6,dict=4KiB"];

// bytes of some letters, in which earlier stretches repeat
const made = (length, letters) => {
  const data = Buffer.alloc(length);
  for (let i = 0; i < length; i++) {
    if (i > 50 && random() < 0.02) {
      const back = 1 + Math.floor(random() * i), end = Math.min(length, i + Math.floor(random() * 300));
      for (; i < end; i++) data[i] = data[i - back];
    }
    if (i < length) data[i] = Math.floor(random() * letters);
  }
  return data;
};

const found = { inputs: 0, differ: 0, silent: 0 };
for (let k = 0; k < 40; k++) {
  const data = made(Math.floor(random() ** 3 * 200000), [1, 2, 4, 256][k % 4]);
  const words = ["--format=lzma", "--lzma1=" + settings[k % 5], "-c"];
  const packed = new Uint8Array(execFileSync("xz", words, { input: data, maxBuffer: 2 ** 28 }));
  found.inputs++;
  if (Buffer.compare(Buffer.from(unlzma(packed)), data)) found.differ++;
  try {
    unlzma(packed.subarray(0, packed.length - 6));
    found.silent++;
  } catch { /* as it should */ }
}
console.log(JSON.stringify(found));
