"""The report on speed against error: what is measured (plan), how (measure), what is made of it (pages, diagrams)."""
