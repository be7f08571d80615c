"""Run by hand: time and error beside other codes and other sizes, and measurements of models."""
