"""Statistical theories of rough contact: Greenwood and Williamson, Greenwood and Tripp, Persson."""
