SELECT printf('%.2000000000c', 'x')
