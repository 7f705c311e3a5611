"""The paper's example as a query stream: r = 0.1, x = (0, 0.445), the directions of 1 to 89 degrees."""
import json
import math

scene = {"dimension": 2, "lattices": [{"vectors": [[1, 0], [0, 1]], "atoms": [{"position": [0, 0], "radius": 0.1}]}]}
print(json.dumps({"scene": scene}))
for degrees in range(1, 90):
    angle = degrees * math.pi / 180
    print(json.dumps({"id": degrees, "x": [0, 0.445], "v": [math.cos(angle), math.sin(angle)]}))
