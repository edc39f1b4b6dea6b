"""The article remade: its figures, its table, and its statements checked (`asperity article`)."""
