"""Scene, plan, both models, uncertainty, verdicts, report and the command line."""
