"""The report on speed against error: what is measured (plan), how (measure), and what is made of it (pages, diagrams)."""
