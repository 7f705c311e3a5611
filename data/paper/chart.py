"""Pictures as SVG, each from numbers alone, so that the same data give the same bytes."""
import math

PALETTE = {"classical": "#d55e00", "published": "#0072b2", "ours": "#009e73", "third": "#aa4499", "grey": "#666666"}


def text(x, y, words, size=20, colour="#222222", anchor="middle", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}" text-anchor="{anchor}"{more}>{words}</text>\n'


def path(points, colour, width=2.0, dash="", fill="none", more=""):
    steps = "".join(f"{'L' if i else 'M'}{x:.1f} {y:.1f}" for i, (x, y) in enumerate(points))
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<path d="{steps}{more}" fill="{fill}" stroke="{colour}" stroke-width="{width}"{dashes}/>\n'


def circle(x, y, r, fill, stroke="none", width=1.5, dash=""):
    dashes = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.1f}" fill="{fill}" stroke="{stroke}" stroke-width="{width}"{dashes}/>\n'


def picture(width, height, title, body):
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
            f'font-family="sans-serif">\n<title>{title}</title>\n<rect width="100%" height="100%" fill="white"/>\n'
            f"{body}</svg>\n")


def power_of_ten(n):
    digits = str(n).translate(str.maketrans("-0123456789", "\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"))
    return {0: "1", 1: "10"}.get(n, "10" + digits)


class Chart:
    """Curves over logarithmic axes (or one that is `even`); the legend stands right of them."""

    LEFT, TOP, WIDTH, HEIGHT = 96, 52, 560, 470

    def __init__(self, title, x_label, y_label, x, y, even=None, legend=250):
        self.title, self.labels, self.x, self.y, self.even, self.legend = title, (x_label, y_label), x, y, even, legend
        self.body, self.entries = "", []

    def place(self, point):
        x = (point[0] - self.x[0]) / (self.x[1] - self.x[0]) if self.even else \
            math.log(point[0] / self.x[0]) / math.log(self.x[1] / self.x[0])
        y = math.log(point[1] / self.y[0]) / math.log(self.y[1] / self.y[0])
        return self.LEFT + self.WIDTH * x, self.TOP + self.HEIGHT * (1 - y)

    def inside(self, points):
        return [point for point in points if self.x[0] <= point[0] <= self.x[1] and self.y[0] <= point[1] <= self.y[1]]

    def curve(self, points, colour, name=None, dash="", width=2.2):
        self.body += path([self.place(point) for point in self.inside(points)], colour, width, dash)
        if name:
            self.entries.append((name, colour, dash, width))

    def dots(self, points, colour, name=None, size=3.2):
        self.body += "".join(circle(*self.place(point), size, colour) for point in self.inside(points))
        if name:
            self.entries.append((name, colour, None, size))

    def words(self, point, words, colour):
        self.body += text(*self.place(point), words, 19, colour)

    def axes(self):
        right, bottom = self.LEFT + self.WIDTH, self.TOP + self.HEIGHT
        grid = labels = ""
        ticks = [(value, f"{value}\u00b0") for value in self.even] if self.even else \
            [(10.0**n, power_of_ten(n)) for n in range(math.ceil(math.log10(self.x[0]) - 1e-9),
                                                       math.floor(math.log10(self.x[1]) + 1e-9) + 1)]
        for value, words in ticks:
            x = self.place((value, self.y[0]))[0]
            grid += f"M{x:.1f} {bottom}V{self.TOP}"
            labels += text(x, bottom + 27, words)
        low, high = math.ceil(math.log10(self.y[0]) - 1e-9), math.floor(math.log10(self.y[1]) + 1e-9)
        for n in range(low, high + 1, 1 + (high - low) // 8):
            y = self.place((self.x[0], 10.0**n))[1]
            grid += f"M{self.LEFT} {y:.1f}H{right}"
            labels += text(self.LEFT - 9, y + 7, power_of_ten(n), anchor="end")
        labels += text((self.LEFT + right) / 2, bottom + 58, self.labels[0])
        labels += text(0, 0, self.labels[1], more=f' transform="translate(26 {(self.TOP + bottom) / 2}) rotate(-90)"')
        return (f'<path d="{grid}" stroke="#dddddd" fill="none"/>\n<path d="M{self.LEFT} {self.TOP}H{right}V{bottom}H{self.LEFT}Z" '
                f'fill="none" stroke="#222222" stroke-width="1.4"/>\n{labels}')

    def svg(self):
        body = self.axes() + self.body + text(self.LEFT, 34, self.title, 22, anchor="start", more=' font-weight="bold"')
        x, y = self.LEFT + self.WIDTH + 16, self.TOP + 14
        for name, colour, dash, width in self.entries:
            body += circle(x + 17, y, width + 1, colour) if dash is None else \
                path([(x, y), (x + 34, y)], colour, width, dash)
            body += text(x + 43, y + 7, name, 19, anchor="start")
            y += 31
        return picture(self.LEFT + self.WIDTH + self.legend, self.TOP + self.HEIGHT + 76, self.title, body)
