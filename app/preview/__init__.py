"""The faces: who is in the picture, where from they are seen, and the threads that draw them."""
