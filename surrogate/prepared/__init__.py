"""Forces prepared once for many calls: decided, proven and cut down to what the scene needs."""
