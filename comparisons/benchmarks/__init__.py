"""How fast the project is: against other codes, against itself at other sizes. Run by hand."""
