"""The sections of single studies: of the section's name is the module, whose SECTION it is."""
