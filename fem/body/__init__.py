"""An elastic block on a mesh: triangles, nodes, material, support, loaded surface."""
