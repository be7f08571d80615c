"""The sections of single studies: one module each, named after its section, with its SECTION."""
