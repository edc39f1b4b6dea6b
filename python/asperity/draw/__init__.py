"""What pictures have in common, and friction as a picture: for results and for scenes."""
