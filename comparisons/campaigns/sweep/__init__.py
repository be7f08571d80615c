"""One scene at many values of some of its fields: how much an answer scatters."""
