"""What takes longer than a moment, on threads and in processes beside the window."""
