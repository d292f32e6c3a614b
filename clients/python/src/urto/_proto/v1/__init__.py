"""Schema urto.v1; written by scripts/generate-proto."""
