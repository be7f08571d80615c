"""The sections of single studies: one module each, named after the section, with its class SECTION."""
