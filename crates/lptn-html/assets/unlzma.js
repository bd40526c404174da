// Unpacks the format of `xz --format=lzma` (LZMA specification, I. Pavlov, 2015, public domain). It throws if the
// bytes end early or name a distance before the beginning; other damage gives other bytes.
const unlzma = packed => {
  // ---- the range coder: probabilities of eleven bits, which move by 1/32 towards the bit found
  const probabilities = count => new Uint16Array(count).fill(1024);
  let at = 13, range = 0xffffffff, code = 0;
  const next = () => {
    if (at >= packed.length) throw new Error("the packed core ends early");
    return packed[at++];
  };
  const normalise = () => {
    if (range < 0x1000000) {
      range = (range << 8) >>> 0;
      code = ((code << 8) | next()) >>> 0;
    }
  };
  const bit = (table, index) => {
    const bound = (range >>> 11) * table[index];
    let found = 0;
    if (code < bound) {
      range = bound;
      table[index] += (2048 - table[index]) >>> 5;
    } else {
      range -= bound;
      code -= bound;
      table[index] -= table[index] >>> 5;
      found = 1;
    }
    normalise();
    return found;
  };
  const direct = count => {
    let found = 0;
    for (; count > 0; count--) {
      range >>>= 1;
      const one = code >= range;
      if (one) code -= range;
      found = found * 2 + (one ? 1 : 0);
      normalise();
    }
    return found;
  };
  const tree = (table, bits, from = 0) => {
    let node = 1;
    for (let k = 0; k < bits; k++) node = node * 2 + bit(table, from + node);
    return node - 2 ** bits;
  };
  const reverse = (table, bits, from = 0) => {
    let node = 1, found = 0;
    for (let k = 0; k < bits; k++) {
      const one = bit(table, from + node);
      node = node * 2 + one;
      found += one * 2 ** k;
    }
    return found;
  };

  // ---- the model
  const lc = packed[0] % 9, lp = Math.floor(packed[0] / 9) % 5, pb = Math.floor(packed[0] / 45);
  const literals = probabilities(0x300 << (lc + lp));
  const lengths = () => ({ choice: probabilities(2), low: probabilities(128), middle: probabilities(128), high: probabilities(256) });
  const length = (model, place) => {
    if (!bit(model.choice, 0)) return 2 + tree(model.low, 3, place * 8);
    if (!bit(model.choice, 1)) return 10 + tree(model.middle, 3, place * 8);
    return 18 + tree(model.high, 8);
  };
  const [matchLength, repeatLength] = [lengths(), lengths()];
  const [isMatch, isLong] = [probabilities(192), probabilities(192)];
  const [isRepeat, isOther, isSecond, isThird] = [0, 0, 0, 0].map(() => probabilities(12));
  const [slots, near, align] = [probabilities(256), probabilities(128), probabilities(16)];
  // the distance minus one; 0xffffffff is the end of the data
  const distance = length => {
    const slot = tree(slots, 6, Math.min(length - 2, 3) * 64);
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1, base = (2 | (slot & 1)) * 2 ** bits;
    if (slot < 14) return base + reverse(near, bits, base - slot);
    return base + direct(bits - 4) * 16 + reverse(align, 4);
  };

  // ---- the bytes: room grows by doubling
  let out = new Uint8Array(1 << 22), size = 0, state = 0, repeats = [0, 0, 0, 0];
  const room = count => {
    if (size + count <= out.length) return;
    const larger = new Uint8Array(2 * (size + count));
    larger.set(out);
    out = larger;
  };
  const copy = count => {
    const back = repeats[0] + 1;
    if (back > size) throw new Error("the packed core is damaged");
    room(count);
    for (const end = size + count; size < end; size++) out[size] = out[size - back];
  };
  const literal = () => {
    const before = size ? out[size - 1] : 0;
    const from = 0x300 * (((size & ((1 << lp) - 1)) << lc) + (before >> (8 - lc)));
    let node = 1;
    if (state >= 7) {
      let match = out[size - repeats[0] - 1];
      while (node < 0x100) {
        const expected = (match >> 7) & 1, found = bit(literals, from + ((1 + expected) << 8) + node);
        match <<= 1;
        node = node * 2 + found;
        if (found != expected) break;
      }
    }
    while (node < 0x100) node = node * 2 + bit(literals, from + node);
    room(1);
    out[size++] = node;
    state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
  };
  // a repeat of one of the last four distances: its length
  const repeated = place => {
    if (!bit(isOther, state)) {
      if (!bit(isLong, state * 16 + place)) {
        state = state < 7 ? 9 : 11;
        return 1;
      }
    } else {
      const which = !bit(isSecond, state) ? 1 : !bit(isThird, state) ? 2 : 3;
      repeats.unshift(...repeats.splice(which, 1));
    }
    state = state < 7 ? 8 : 11;
    return length(repeatLength, place);
  };

  next();
  for (let k = 0; k < 4; k++) code = ((code << 8) | next()) >>> 0;
  // the header has the size, or 255 eight times if the end is marked
  const marked = packed.subarray(5, 13).every(byte => byte == 255);
  const whole = marked ? Infinity : new DataView(packed.buffer, packed.byteOffset + 5, 4).getUint32(0, true);
  while (size < whole) {
    const place = size & ((1 << pb) - 1);
    if (!bit(isMatch, state * 16 + place)) {
      literal();
    } else if (bit(isRepeat, state)) {
      copy(repeated(place));
    } else {
      const count = length(matchLength, place), far = distance(count);
      if (far == 0xffffffff) {
        if (code || at != packed.length) throw new Error("the packed core is damaged");
        break;
      }
      repeats = [far, ...repeats.slice(0, 3)];
      state = state < 7 ? 7 : 10;
      copy(count);
    }
  }
  return out.subarray(0, size);
};

// The bytes that are written as five letters for four (src/base85.rs).
const bytesOf = text => {
  const values = new Uint8Array(128);
  let count = 0;
  for (let code = 33; code < 127; code++) if (!"\"$&'<>\\`~".includes(String.fromCharCode(code))) values[code] = count++;
  const bytes = new Uint8Array(text.length - Math.ceil(text.length / 5));
  for (let from = 0, to = 0; from < text.length; from += 5) {
    let number = 0;
    for (let i = 0; i < 5; i++) number = number * 85 + (from + i < text.length ? values[text.charCodeAt(from + i)] : 84);
    for (let shift = 24; shift >= 0 && to < bytes.length; shift -= 8) bytes[to++] = number >>> shift;
  }
  return bytes;
};
