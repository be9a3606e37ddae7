"""Curves over time, one below the other, as SVG."""
from html import escape

WIDTH, HEIGHT, LEFT, TOP, GAP = 900, 130, 90, 50, 46


def curve(samples, key, top):
    """One curve with its frame and the values of its borders."""
    points = [(sample["seconds"], sample[key]) for sample in samples if sample.get(key) is not None]
    if not points:
        return []
    low, high = min(value for _, value in points), max(value for _, value in points)
    margin = (high - low) * 0.05 or max(abs(high) * 0.05, 1)
    low, high = low - margin, high + margin
    longest = max(second for second, _ in points) or 1

    def place(point):
        return (f"{LEFT + (WIDTH - LEFT - 20) * point[0] / longest:.1f},"
                f"{top + HEIGHT - HEIGHT * (point[1] - low) / (high - low):.1f}")

    return [
        f'<rect x="{LEFT}" y="{top}" width="{WIDTH - LEFT - 20}" height="{HEIGHT}" fill="none" stroke="#999"/>',
        f'<text x="{LEFT - 6}" y="{top + 10}" text-anchor="end">{high:.4g}</text>',
        f'<text x="{LEFT - 6}" y="{top + HEIGHT}" text-anchor="end">{low:.4g}</text>',
        f'<polyline fill="none" stroke="#0b62a4" stroke-width="1.5" points="{" ".join(map(place, points))}"/>',
    ]


def plot(title, samples, curves):
    """`curves`: pairs of a key of the samples and its title."""
    bottom = TOP + len(curves) * (HEIGHT + GAP)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{bottom}" font-family="sans-serif" font-size="12">',
        f'<rect width="{WIDTH}" height="{bottom}" fill="#fff"/>',
        f'<text x="{LEFT}" y="20" font-size="15">{escape(title)}</text>',
    ]
    for index, (key, name) in enumerate(curves):
        top = TOP + index * (HEIGHT + GAP)
        lines.append(f'<text x="{LEFT}" y="{top - 6}">{escape(name)}</text>')
        lines += curve(samples, key, top)
    last_s = samples[-1]["seconds"] if samples else 0
    lines.append(f'<text x="{WIDTH - 20}" y="{bottom - GAP + 18}" text-anchor="end">{last_s / 60:.1f} minutes</text>')
    return "\n".join([*lines, "</svg>\n"])
