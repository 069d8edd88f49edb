"""Pictures that tests look at pixel by pixel."""

import struct
import zlib


class Picture:
    """The bytes of a PNG of 8 bits without interlace."""

    def __init__(self, png):
        at, packed = 8, b""
        while at < len(png):
            length, kind = struct.unpack(">I4s", png[at:at + 8])
            if kind == b"IHDR":
                self.width, self.height, _, color = struct.unpack(">IIBB", png[at + 8:at + 18])
                self.channels = {2: 3, 6: 4}[color]
            elif kind == b"IDAT":
                packed += png[at + 8:at + 8 + length]
            at += 12 + length
        self.rows = self._unfiltered(zlib.decompress(packed))

    def _unfiltered(self, raw):
        size, reach = self.width * self.channels, self.channels
        rows, above = [], bytes(size)
        for y in range(self.height):
            kind, row = raw[y * (size + 1)], bytearray(raw[y * (size + 1) + 1:(y + 1) * (size + 1)])
            for k in range(size if kind else 0):
                left, up, corner = (row[k - reach], above[k], above[k - reach]) if k >= reach else (0, above[k], 0)
                add = {1: left, 2: up, 3: (left + up) // 2, 4: None}[kind]
                if add is None:
                    add = self._nearest(left, up, corner)
                row[k] = (row[k] + add) & 255
            rows.append(bytes(row))
            above = rows[-1]
        return rows

    def at(self, x, y):
        return self.rows[y][x * self.channels:x * self.channels + 3]

    def body(self):
        """Left, top, right and bottom of what is not paper."""
        paper = self.at(0, 0)
        seen = [(x, y) for y in range(self.height) for x in range(self.width) if self.at(x, y) != paper]
        xs, ys = [x for x, _ in seen], [y for _, y in seen]
        return min(xs), min(ys), max(xs) + 1, max(ys) + 1

    def differs(self, other, right=0, down=0):
        """Share of the pixels that the other picture, moved, has otherwise by more than two levels."""
        count = wrong = 0
        begin, end = max(0, right), min(self.width, self.width + right)
        for y in range(max(0, down), min(self.height, self.height + down)):
            count += end - begin
            one = self.rows[y][begin * self.channels:end * self.channels]
            two = other.rows[y - down][(begin - right) * other.channels:(end - right) * other.channels]
            if one != two:
                apart = [abs(a - b) > 2 for a, b in zip(one, two)]
                wrong += sum(any(apart[k:k + self.channels]) for k in range(0, len(apart), self.channels))
        return wrong / count

    def packed(self):
        """The bytes of a PNG of the same pixels, as small as filters and zlib make them."""
        raw, above = bytearray(), bytes(self.width * self.channels)
        for row in self.rows:
            raw += min((self._filtered(kind, row, above) for kind in (0, 1, 2, 4)),
                       key=lambda line: sum(min(x, 256 - x) for x in line[1:]))
            above = row
        size = struct.pack(">IIBBBBB", self.width, self.height, 8, {3: 2, 4: 6}[self.channels], 0, 0, 0)
        parts = [(b"IHDR", size), (b"IDAT", zlib.compress(bytes(raw), 9)), (b"IEND", b"")]
        return b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in parts)

    def _filtered(self, kind, row, above):
        reach = self.channels
        if kind == 0:
            return bytes([0]) + row
        left = bytes(reach) + row[:-reach]
        if kind == 4:
            before = map(self._nearest, left, above, bytes(reach) + above[:-reach])
        else:
            before = left if kind == 1 else above
        return bytes([kind]) + bytes((x - b) & 255 for x, b in zip(row, before))

    @staticmethod
    def _nearest(left, up, corner):
        """Paeth's predictor."""
        guess = left + up - corner
        to_left, to_up, to_corner = abs(guess - left), abs(guess - up), abs(guess - corner)
        if to_left <= to_up and to_left <= to_corner:
            return left
        return up if to_up <= to_corner else corner
