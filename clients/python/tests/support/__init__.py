"""What the client's tests stand on."""
