"""What is made of measurements: the report on speed against error (plan, measure, pages, diagrams), and the pictures of
the benchmarks (speed_diagram, scaling_diagram)."""
