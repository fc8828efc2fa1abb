# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects in a picture by Cryptomatte 1.2.0, as Cycles writes it."""
import numpy

MASK = 0xFFFFFFFF


def murmur3(data, seed=0):
    """MurmurHash3_x86_32."""
    hashed = seed
    whole = len(data) // 4 * 4
    for i in range(0, whole, 4):
        hashed ^= _mixed(int.from_bytes(data[i:i + 4], "little"))
        hashed = (_turned(hashed, 13) * 5 + 0xE6546B64) & MASK
    if whole < len(data):
        hashed ^= _mixed(int.from_bytes(data[whole:], "little"))
    hashed ^= len(data)
    hashed = ((hashed ^ hashed >> 16) * 0x85EBCA6B) & MASK
    hashed = ((hashed ^ hashed >> 13) * 0xC2B2AE35) & MASK
    return hashed ^ hashed >> 16


def _turned(value, bits):
    return (value << bits | value >> (32 - bits)) & MASK


def _mixed(word):
    return _turned(word * 0xCC9E2D51 & MASK, 15) * 0x1B873593 & MASK


def identifier(name):
    """The bits of the float that stands for a name; never those of a denormal, an infinity or NaN."""
    bits = murmur3(name.encode("utf-8"))
    return bits ^ 1 << 23 if bits >> 23 & 255 in (0, 255) else bits


def coverage(channels, layer, name):
    """The share of each pixel that the object covers."""
    wanted, share = numpy.uint32(identifier(name)), 0
    for level in range(16):
        rank = f"{layer}.CryptoObject{level:02}"
        if f"{rank}.r" not in channels:
            break
        for who, how_much in ("rg", "ba"):
            bits = numpy.ascontiguousarray(channels[f"{rank}.{who}"]).view(numpy.uint32)
            share = share + numpy.where(bits == wanted, channels[f"{rank}.{how_much}"], 0)
    return share


def median_depth(channels, layer, name, depth):
    """Median depth of pixels that the object covers by more than half, else of all it covers; None: not in sight."""
    share = numpy.broadcast_to(coverage(channels, layer, name), depth.shape)
    for least in (0.5, 0):
        found = depth[(share > least) & numpy.isfinite(depth)]
        if found.size:
            return float(numpy.median(found))
    return None
