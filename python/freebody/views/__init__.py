"""Pictures of runs: plots, drawings, animations and the report. Views read runs and scenes, never the solver."""
