"""What friction returns, and what its notes say."""
