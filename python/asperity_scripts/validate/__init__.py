"""Corrections held against exact contact, elastic and sliding (`asperity validate`)."""
